# Everything a newcomer needs: `make demo`, `make test`, `make bench`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
TOOLS := build/release-tools

.PHONY: demo test bench fuzz docs truth check packages try-install release-check lock clean
.DELETE_ON_ERROR:

demo: $(VENV)/.ready
	$(BIN)/stiction run examples/soft_film.toml --out demo

test: $(VENV)/.ready
	$(BIN)/python -m pytest -n auto --dist loadfile --no-loadscope-reorder

bench: $(VENV)/.ready
	$(BIN)/python benchmarks/run.py

# Commands and other inputs at random, for so many minutes: make fuzz FIRST=1000 MINUTES=30
FIRST := 0
MINUTES := 5
fuzz: $(VENV)/.ready
	$(BIN)/python fuzz/run.py --first $(FIRST) --minutes $(MINUTES)

# The site, build/docs/html/index.html: to be opened in a browser, without a network.
docs: $(VENV)/.ready
	$(BIN)/python docs/site/build.py

# The set of solved surfaces that models are measured by: half an hour on one core; goes on where it was stopped.
truth: $(VENV)/.ready
	cd truth && ../$(BIN)/python solve.py && ../$(BIN)/python models.py && ../$(BIN)/python pack.py
	cd docs && ../$(BIN)/python truth_tables.py && ../$(BIN)/python make_tables.py

check: $(VENV)/.ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	$(BIN)/lint-imports

$(VENV)/.ready: requirements.lock pyproject.toml
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "stiction needs Python 3.11 or newer; name one with: make PYTHON=python3.12 $(MAKECMDGOALS)"; exit 1; }
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@touch $@

# Wheel and sdist, build/dist, checked: what is said of them, and what is in them.
packages: $(VENV)/.ready $(TOOLS)/.ready
	rm -rf build/dist
	$(BIN)/hatchling build -d build/dist
	$(TOOLS)/bin/twine check --strict build/dist/*
	$(BIN)/python release/contents.py build/dist

# The wheel in empty environments, alone and with each extra: takes minutes, and needs what pip reaches.
try-install: packages
	$(BIN)/python release/try_install.py

# Everything that has to hold before a version is given away; says what is left to do by hand.
release-check: $(VENV)/.ready $(TOOLS)/.ready
	$(BIN)/python release/check.py

# What only a release needs has an environment of its own.
$(TOOLS)/.ready: release/tools.lock
	$(PYTHON) -m venv $(TOOLS)
	$(TOOLS)/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r release/tools.lock
	@touch $@

# Maintainers only: needs the tool uv.
LOCKED := uv pip compile --quiet --universal --generate-hashes --no-header --python-version 3.11
lock:
	$(LOCKED) --extra dev pyproject.toml -o requirements.lock
	$(LOCKED) release/tools.in -o release/tools.lock

clean:
	rm -rf $(VENV) demo build
