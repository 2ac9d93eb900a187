# `make reproduce` performs the experiment, `make test` runs the tests; both set up .venv first.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
SEEDS ?= 3
OUT ?= runs/default
READY := $(VENV)/.ready

.PHONY: reproduce test test-all lint benchmarks clean

reproduce:
	@echo "The report will be at $(OUT)/report.html"
	@$(MAKE) --no-print-directory $(READY)
	@$(BIN)/motionese reproduce --seeds $(SEEDS) --out $(OUT)

test: $(READY) lint
	@$(BIN)/python -m pytest -n 2 -m "not slow" --cov --cov-report=term

test-all: $(READY) lint
	@$(BIN)/python -m pytest -n 2 --cov --cov-report=term

lint: $(READY)
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy

benchmarks: $(READY)
	@for file in benchmarks/*.py; do $(BIN)/python $$file || exit 1; done

$(READY): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "motionese needs Python 3.11 or newer; name one: make PYTHON=python3.12 ..."; exit 2; }
	@echo "Setting up $(VENV) (once; about a minute) ..."
	@$(PYTHON) -m venv $(VENV)
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt -e ".[dev,vision]"
	@touch $@

clean:
	rm -rf $(VENV) build dist .mypy_cache .pytest_cache .ruff_cache .coverage*
