"""Which modules are made wrong, and which tests ought to notice: folders of laws by their kind, the rest by name.

Tests stand in the order in which they are asked, those that take seconds first. `LAST` is asked where all of these pass.
"""

from typing import NamedTuple

TABLES = "tests/contract/test_reference_tables.py"
# Results held to what they were, which say nothing of whether they are right: a kill by them alone is counted apart.
LAST = ("tests/pinned",)


class Part(NamedTuple):
    """name; modules: patterns below src/stiction; tests: paths from the root; pinned: whether LAST is asked too."""

    name: str
    modules: tuple[str, ...]
    tests: tuple[str, ...]
    pinned: bool = True


def _tests(folder: str, *names: str) -> tuple[str, ...]:
    return tuple(f"tests/{folder}/test_{name}.py" for name in names)


PARTS = (
    Part("asperity laws", ("laws/asperity/*.py", "laws/asperity/shared/*.py"),
         (TABLES, *_tests("asperity", "asperities", "adhesive", "elastic_plastic", "hardening", "unloading"),
          "tests/contract/test_asperity_records.py")),
    Part("tangential laws", ("laws/tangential/*.py", "laws/tangential/shared/*.py"),
         (TABLES, *_tests("friction", "tangential_laws", "hamilton", "junctions", "layered_friction", "layered_lesser"))),
    Part("film laws", ("laws/film/*.py", "laws/film/shared/*.py"),
         (TABLES, *_tests("coating", "films_published", "plastic_films", "graded", "graded_by_hand", "layered", "in_series",
                          "two_bodies", "film_errors"), "tests/contract/test_film_limits.py")),
    Part("rough surfaces", ("laws/rough_surface/*.py", "laws/rough_surface/shared/*.py"),
         (TABLES, *_tests("models", "rough_surfaces", "spectral", "corrected_diffusion", "persson_widened", "n_point",
                          "full_contact", "rough_on_film", "map_contact"))),
    Part("other laws", ("laws/composite/*.py", "laws/meniscus/*.py", "laws/ageing/*.py", "laws/contamination/*.py",
                        "laws/criterion/*.py", "laws/presliding/*.py", "laws/presliding/shared/*.py"),
         (*_tests("coating", "two_bodies", "films_published"), "tests/menisci",
          *_tests("friction", "ageing", "ageing_beyond_measured", "contamination", "sliding_inception", "sliding"),
          "tests/models/test_spectral.py")),
    Part("joining", ("laws/joining.py", "laws/segment.py"), (TABLES, *_tests("friction", "joining", "tangential_laws"))),
    Part("units", ("quantities/units.py", "quantities/dimensions.py", "quantities/inputs.py",
                   "quantities/quantity.py"),
         ("tests/units", "tests/evaluate/test_refusals.py", "tests/case/test_case.py", "tests/case/test_hostile.py",
          "tests/contact/test_contact.py", "tests/materials")),
    Part("groups", ("contact/indices.py", "contact/pair.py", "contact/contact.py", "surfaces/roughness.py",
                    "contact/size_effect.py"),
         (*_tests("contact", "size_effect", "contact", "bounds_of_groups", "wrong_use"),
          "tests/compare/test_kind_of_surface.py", "tests/contract/test_swapped_bodies.py", "tests/evaluate/test_evaluate.py")),
    Part("layers", ("solvers/layered/*.py",), _tests("contact", "layered_sphere", "layered_stresses", "layered_yield")),
    Part("engine", ("engine/heights.py", "engine/bisection.py", "engine/crossings.py", "engine/skeleton.py",
                    "engine/summation.py", "engine/sum_kernels.py", "engine/starting_separations.py"),
         (*_tests("engine", "crossings", "heights", "skeleton", "summation", "threads", "tiers"), TABLES,
          *_tests("evaluate", "inversion", "loads_asked", "tiny_loads"))),
    Part("inversion", ("solving/inversion.py", "solving/unloading.py", "solving/pointwise.py",
                       "solving/accuracy/measured_error.py", "solving/sliding.py"),
         (*_tests("evaluate", "inversion", "loads_asked", "tiny_loads"), "tests/models/test_unloading_sums.py",
          "tests/compare/test_measured_error.py", "tests/friction/test_sliding.py", "tests/uncertain/test_bands.py")),
    Part("statistics", ("surfaces/statistics.py", "surfaces/spectrum.py", "surfaces/prepare.py", "surfaces/johnson.py",
                        "surfaces/theory/*.py", "surfaces/asperity_method/*.py", "surfaces/asperity_method/shared/*.py"),
         (*_tests("surfaces", "statistics", "spectrum", "prepare", "asperity_methods", "generate", "edges"),
          "tests/models/test_spectral.py"), False),
    Part("map contact", ("solvers/boundary_elements/*.py",),
         (*_tests("solvers/boundary_elements", "compliance", "known_contacts", "area_estimates", "map_area",
                  "sizes_and_pixels", "menisci_on_maps", "sticking_maps"), "tests/models/test_map_contact.py"), False),
    Part("sweeps", ("studies/sweep/plan.py", "studies/sweep/blocks.py", "studies/sweep/store.py",
                    "studies/sweep/quantile_counts.py", "case/swept.py"),
         (*_tests("several", "quantile_counts", "several", "sweep"),), False),
    Part("uncertainty", ("case/distribution.py", "studies/sensitivity/indices_of_variance.py",
                         "studies/sensitivity/log_sensitivities.py", "studies/uncertainty/bands.py"),
         _tests("uncertain", "indices", "uncertain_numbers", "bands", "sensitivity"), False),
    Part("fits", ("studies/fit/model.py", "studies/fit/answer.py", "studies/fit/bands.py", "studies/fit/model_comparison.py",
                  "studies/fit/search.py", "case/measurements.py"),
         _tests("fit", "measurements", "fit"), False),
)  # fmt: skip
