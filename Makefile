# `make reproduce` performs the experiment, `make test` runs the tests; both set up .venv first.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
SEEDS ?= 3
OUT ?= runs/reproduce
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check -c constraints.txt
PYTEST := $(BIN)/python -m pytest -n 2 --no-loadscope-reorder --cov --cov-report=term
RESULTS := runs/results
CONFIRM := $(BIN)/motionese reproduce --seeds 1000-1029 --set evaluation.roles.adam=800
READY := $(VENV)/.ready
TOOLS := $(VENV)/.tools

.PHONY: reproduce results test test-all lint docs benchmarks page-vendor clean

reproduce:
	@echo "The report will be at $(OUT)/report.html"
	@$(MAKE) --no-print-directory -s $(READY)
	@$(BIN)/motionese reproduce --preset default order --seeds $(SEEDS) --out $(OUT)

# The results that are kept, in the package and in docs/results, made again: 270 runs, about an
# hour on two cores (docs/plan.md).
results: $(READY)
	@$(CONFIRM) --preset order default --out $(RESULTS)
	@$(CONFIRM) --preset free --conditions TD/MD --out $(RESULTS)/free
	@$(BIN)/python docs/results/keep.py $(RESULTS)/order $(RESULTS)/default $(RESULTS)/free

test: $(TOOLS) lint
	@$(PYTEST) -m "not slow"

# Compiled as users do; the quick tests compile in another way (tests/conftest.py).
test-all: export XLA_FLAGS = --xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1
test-all: $(TOOLS) lint
	@$(PYTEST)

lint: $(TOOLS)
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy

docs: $(TOOLS)
	@$(BIN)/python -m sphinx -W --keep-going -q docs build/docs
	@echo "The pages are at build/docs/index.html"

benchmarks: $(TOOLS)
	@$(PIP) -e ".[dev,benchmarks]"
	@for file in benchmarks/*.py; do $(BIN)/python $$file || exit 1; done

# What the page of `motionese teach` takes from others, built anew (needs node; nothing else does).
page-vendor:
	@src/motionese/interfaces/page/web/vendor/build.sh

$(READY): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
		{ echo "motionese needs Python 3.11 or newer; name one: make PYTHON=python3.12 ..."; exit 2; }
	@echo "Setting up $(VENV) (once; about a minute) ..."
	@$(PYTHON) -m venv $(VENV)
	@$(PIP) -e ".[experiment,vision]"
	@touch $@

$(TOOLS): $(READY)
	@echo "Adding what the tests and the docs need (once; about a minute) ..."
	@$(PIP) -e ".[dev]"
	@touch $@

clean:
	rm -rf $(VENV) build dist .mypy_cache .pytest_cache .ruff_cache .coverage*
