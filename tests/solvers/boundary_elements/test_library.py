"""Against another program's solution of the same maps: `library.csv`, made by `make_library.py`."""

import csv
from pathlib import Path

import numpy as np
import pytest
from make_library import heights

from stiction.solvers.boundary_elements.solve import solve_map

ROWS = list(csv.DictReader((Path(__file__).parent / "library.csv").read_text(encoding="utf-8").splitlines()))


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['boundary']}-{row['hardness']}-{row['mean']}")
def test_a_map_is_solved_as_by_the_library(row):
    hardness, mean = float(row["hardness"]), float(row["mean"])
    how = {"periodic": row["boundary"] == "periodic", "hardness": None if np.isinf(hardness) else hardness, "stiffness": False}
    (found,) = solve_map(heights(int(row["seed"])), (1.0, 1.0), modulus=1.0, loads=[mean], free=True, **how)
    assert found.area_pixels == pytest.approx(float(row["area"]), abs=1.1 / 64**2, rel=1e-5)  # one point may be at the verge
    assert np.mean(found.pressure**2) == pytest.approx(float(row["square"]), rel=1e-5)
    assert found.pressure.max() == pytest.approx(float(row["largest"]), rel=1e-4)
