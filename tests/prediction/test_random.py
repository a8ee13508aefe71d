"""Nothing impossible in predictions of random contacts (validation/random_predictions.py has 10^4 of them)."""

import importlib.util
from pathlib import Path


def script():
    path = Path(__file__).parents[2] / "validation" / "random_predictions.py"
    spec = importlib.util.spec_from_file_location("random_predictions", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_random_contacts_are_predicted_without_a_fault_or_refused_in_a_line():
    found, refused = script().run(40, seed=2)
    assert found == []
    assert refused[""] >= 15 and sum(refused.values()) == 40
