# Three commands for everybody: make demo, make test, make lab. The rest is for those who work on priorlab.
# Needs Python 3.11 or newer, pip and make; nothing else. Everything is installed into .venv.

PYTHON ?= python3
VENV   ?= .venv
BIN    := $(VENV)/bin
READY  := $(VENV)/.ready
OUT    ?= out/demo
JOBS   ?= 2
# for make lab; as root in a container: make lab LAB_ARGS=--allow-root
LAB_ARGS ?=

.DEFAULT_GOAL := help
# Pictures go to files there; in JupyterLab they go to the page.
demo test mutants notebooks coverage bench figures api real: export MPLBACKEND = Agg
.PHONY: help demo test mutants lab notebooks lint types coverage bench bench-browser figures api real lock clean

help:  ## show this list
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 16

demo: $(READY)  ## one floor plan all the way, from the drawing to FastSLAM; leaves a report in out/demo
	$(BIN)/priorlab demo --out $(OUT) --force

test: $(READY)  ## unit tests, doctests and the notebooks through strict nbval
	$(BIN)/python -m pytest -n $(JOBS) --dist loadfile --doctest-glob='*.md' -m 'not mutant' tests priorlab docs
	$(BIN)/python -m pytest -n $(JOBS) --dist loadfile --nbval --nbval-current-env --nbval-cell-timeout=120 notebooks

mutants: $(READY)  ## the tests of the tests: wrong code in a copy of priorlab must turn a notebook red (4 minutes)
	$(BIN)/python -m pytest -n $(JOBS) --dist load -q -m mutant tests/notebooks

lab: $(READY)  ## open the course in JupyterLab (token on, this machine only)
	cd notebooks && ../$(BIN)/jupyter lab --ServerApp.ip=127.0.0.1 \
		--ServerApp.kernel_websocket_connection_class=priorlab.course.prompt_server.PromptConnection $(LAB_ARGS) 00_start_here.ipynb

notebooks: $(READY)  ## run all notebooks again, without widget state, and show what changed
	$(BIN)/python -m priorlab.course.execute notebooks

lint: $(READY)  ## ruff, check and format
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(READY)  ## mypy on the package
	$(BIN)/mypy

coverage: $(READY)  ## branch coverage of the mathematics (fails below 95 %)
	$(BIN)/python -m pytest -n $(JOBS) --dist loadfile -q tests/core tests/mapping tests/optimize tests/slam tests/robot \
		--cov=priorlab.core --cov=priorlab.mapping --cov=priorlab.optimize --cov=priorlab.slam --cov=priorlab.robot \
		--cov-branch --cov-report=term-missing:skip-covered --cov-fail-under=95

bench: $(READY)  ## speed, as tables of ratios against the alternative
	$(BIN)/python -m pytest -q -s tests/benchmarks

bench-browser: $(READY)  ## sliders in a real browser, key press to painted picture (needs chromium, and playwright in .venv)
	$(BIN)/python tests/benchmarks/browser_sliders.py

api: $(READY)  ## write the snapshot of the public names anew (look at the change before you commit it)
	$(BIN)/python tests/project/public_api.py > tests/project/public_api.txt

figures: $(READY)  ## the thesis's figures and tables anew, with numbers and verdicts, into figures/
	$(BIN)/priorlab figures all --out figures --force

real: $(READY)  ## the tests on real data: make real DATA=folder
	@test -n "$(DATA)" || { echo "say where the real data lies: make real DATA=folder"; exit 2; }
	PRIORLAB_REAL_DATA="$(DATA)" $(BIN)/python -m pytest -q -s -k real tests

lock:  ## write constraints.txt anew from a fresh environment with the newest versions
	rm -rf $(VENV)-lock && $(PYTHON) -m venv $(VENV)-lock
	$(VENV)-lock/bin/pip install --quiet --upgrade pip && $(VENV)-lock/bin/pip install --quiet --editable '.[lab,test]'
	{ sed -n '/^#/p' constraints.txt; $(VENV)-lock/bin/pip freeze --exclude-editable; } > constraints.new && mv constraints.new constraints.txt
	rm -rf $(VENV)-lock

clean:  ## remove the environment and what was made
	rm -rf $(VENV) out dist build .pytest_cache .mypy_cache .ruff_cache .hypothesis

# pip --python installs into an environment that has no pip of its own: enough where a system's Python lacks ensurepip.
$(READY): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { echo "priorlab needs Python 3.11 or newer, got $$($(PYTHON) --version 2>&1): make PYTHON=python3.11 ..."; exit 2; }
	@echo "Setting up $(VENV), once; about a minute."
	$(PYTHON) -m venv --without-pip $(VENV)
	$(PYTHON) -m pip --python $(BIN)/python install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[lab,test]'
	touch $(READY)
