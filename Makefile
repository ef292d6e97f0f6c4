# Everything a newcomer needs, each target in the same virtual environment.
#
#   make PYTHON=python3.12 demo     to choose the interpreter (3.11 or 3.12)

VENV := .venv
BIN := $(VENV)/bin
BAG := bags/demo
OUTPUT := demo_output
# One more than two cores: some tests wait for processes, devices and a browser.
WORKERS := 3

.DEFAULT_GOAL := help
# Demo and tests start hundreds of processes; without byte code on disk each compiles the package.
unexport PYTHONDONTWRITEBYTECODE
.PHONY: help demo test pytest lint format types config docs dist golden bags bench clean

help: ## show the targets
	@grep -hE '^[a-z]+:.*## ' $(MAKEFILE_LIST) | sort | sed -E 's/^([a-z]+):.*## /\1|/' \
		| awk -F'|' '{ printf "  make %-8s %s\n", $$1, $$2 }'

# The stamp makes reruns quick; delete .venv (make clean) to start afresh.
$(VENV)/.installed: setup.py scripts/make_venv
	@scripts/make_venv $(VENV)
	@touch $@

$(VENV)/.kernel: $(VENV)/.installed $(wildcard dualfoot_ros/core/kernel/*.py dualfoot_ros/core/compiler/*.py)
	@echo "compiling the kernel (once; some seconds, half a minute without a C compiler)"
	@$(BIN)/python -m dualfoot_ros.core.compiler
	@touch $@

demo: $(VENV)/.kernel ## replay bags/demo through the real nodes and compare with the truth
	@$(BIN)/python -m dualfoot_ros.nodes.demo $(BAG) -o $(OUTPUT)

# The checks two at a time, and then the tests, which need all of the machine.
test: $(VENV)/.kernel ## run ruff, mypy, every test; build docs/, wheel and sdist
	@$(MAKE) --no-print-directory -j2 dist types lint docs
	@$(MAKE) --no-print-directory pytest

pytest: $(VENV)/.kernel ## run the tests only
	@OPENBLAS_NUM_THREADS=1 $(BIN)/python -m pytest -n $(WORKERS) --dist loadfile

lint: $(VENV)/.installed ## check style and format with ruff
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .

types: $(VENV)/.installed ## check the types with mypy
	@$(BIN)/mypy

format: $(VENV)/.installed ## format the code with ruff
	@$(BIN)/ruff check --fix --select I .
	@$(BIN)/ruff format .

config: $(VENV)/.installed ## write the generated files of config/ from the declarations
	@$(BIN)/python scripts/write_config.py

docs: $(VENV)/.installed ## build docs/ as a site in build/site; a broken link is an error
	@$(BIN)/mkdocs build --strict --quiet
	@echo build/site/index.html

# The wheel is built from the source distribution, so that a file missing there is missed here.
dist: $(VENV)/.kernel ## build wheel and source distribution in dist/, and use the wheel without ROS
	@rm -rf dist && mkdir -p build
	@$(BIN)/python -m build --no-isolation --outdir dist >build/dist.log 2>&1 \
		|| { cat build/dist.log >&2; exit 1; }
	@scripts/check_wheel $(BIN)/python

golden: $(VENV)/.kernel ## write the golden tracks of the tests anew (and say why in the commit)
	@$(BIN)/python scripts/golden_tracks.py

bags: $(VENV)/.kernel ## regenerate the recordings in bags/
	@$(BIN)/python scripts/make_bags.py

bench: $(VENV)/.kernel ## print the cost of an epoch, compiled and interpreted
	@$(BIN)/python -m benchmark

clean: ## remove the environment, caches and everything that was built
	@rm -rf $(VENV) build install log dist $(OUTPUT) *.egg-info
	@rm -rf .pytest_cache .ruff_cache .mypy_cache .hypothesis
	@find . -name __pycache__ -type d -prune -exec rm -rf {} +
