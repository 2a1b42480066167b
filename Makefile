# Everything a person types: make weave, make test, make bench, make docs. Each sets up what it needs.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet

# A fresh .venv keeps its bytecode, whatever the shell says: every later start is faster.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help weave studio client client-check browser test lint types layers unit campaigns shapes mutants fuzz kills cuts bench docs dist venv lock clean

help:
	@echo "make weave   weave the shipped example and print where its report lies"
	@echo "make studio  open the studio on the shipped example, in a browser"
	@echo "make test    every check and every test, and the seconds of each phase (lint, layers, types, unit, client-check, browser)"
	@echo "make campaigns  much random input for every law (hours); SHARE=1: a share, five minutes; SEED=7: these cases; parts by PARTS=\"kills cuts\":"
	@echo "     make shapes  the engine's tests with the shapes of all arrays checked"
	@echo "     make mutants small wrong changes of the sources, and which of them no test notices (about an hour)"
	@echo "     make fuzz    20,000 hostile inputs for every command (about ten minutes)"
	@echo "     make kills   500 signals at random instants of real commands: no result is lost, no message is false (10 minutes)"
	@echo "     make cuts    power cuts and kills while carpets are woven: every knot is in them once (five minutes)"
	@echo "make client  the studio's client from its sources, into the package (needs Node)"
	@echo "make bench   the benchmarks, side by side with their peers"
	@echo "make docs    the documentation, in docs/_build/html"
	@echo "make dist    wheel and sdist, each installed into an empty environment and tried there (five to eight minutes)"
	@echo "make venv    .venv with everything for development"

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "ilmek needs Python 3.11 or newer; " + sys.executable + " is " + sys.version.split()[0] + ". Try: make PYTHON=python3.12 ...")'
	@$(PYTHON) -m venv $(VENV) || { echo "could not make $(VENV): on Debian and Ubuntu, apt-get install python3-venv"; rm -rf $(VENV); exit 1; }

$(VENV)/.installed: pyproject.toml constraints.txt | $(BIN)/python
	@echo "installing ilmek into $(VENV) (once; about a minute)"
	@ILMEK_KERNELS=no $(PIP) install --constraint constraints.txt --editable .
	@$(BIN)/python -m ilmek.jobs.warm
	@touch $@

$(VENV)/.installed-dev: pyproject.toml constraints.txt | $(BIN)/python
	@echo "installing ilmek and its development tools into $(VENV) (once; about two minutes)"
	@ILMEK_KERNELS=no $(PIP) install --constraint constraints.txt --editable '.[dev]'
	@$(BIN)/python -m ilmek.jobs.warm
	@touch $(VENV)/.installed $@

venv: $(VENV)/.installed-dev

weave: $(VENV)/.installed
	@$(BIN)/ilmek weave examples/medallion.png --size seccade --quality 25x25/dm --out out/medallion --force

# The project is out/studio; without it the example is copied there. Options as of `ilmek studio --help`:
# make studio STUDIO="my-project --no-browser"
STUDIO ?= out/studio
studio: $(VENV)/.installed
	@$(BIN)/ilmek studio $(STUDIO)

studio/node_modules/.installed: studio/package.json studio/package-lock.json
	@cd studio && npm ci --no-audit --no-fund --loglevel=error
	@touch $@

# Users need no Node: the built client is in the package. Who changes studio/src builds it again.
client: venv studio/node_modules/.installed
	PYTHONPATH=src $(BIN)/python -m ilmek.web.schema studio/src/api
	PYTHONPATH=src $(BIN)/python -m ilmek mechanism --schema > studio/src/api/mechanism.json
	PYTHONPATH=src $(BIN)/python -m ilmek.web.api_page docs/reference/studio-api.md
	cd studio && npm run --silent types && npm run --silent build

# Without Node the tests still prove, by a digest, that the shipped client is the build of the sources.
client-check:
	@if command -v npm >/dev/null; then $(MAKE) --no-print-directory studio/node_modules/.installed && cd studio && npm run --silent check && npm run --silent test && npm run --silent verify; \
	else echo "npm is missing: the client's own tests are left out"; fi

# The tests in a browser need Chromium, from the packages of the system where they may be installed.
browser: venv
	@command -v chromium >/dev/null || command -v chromium-browser >/dev/null || command -v google-chrome >/dev/null \
	|| { [ "$$(id -u)" = 0 ] && command -v apt-get >/dev/null && { apt-get update -qq; apt-get install -y -qq --no-install-recommends chromium; } >/dev/null 2>&1; } \
	|| echo "Chromium is missing and cannot be installed here: the tests in a browser are left out"
	$(BIN)/pytest -n 2 --dist loadfile tests/browser || { echo "what failed, once more and alone: passing now, it depends on the load, a fault to be mended"; \
	$(BIN)/pytest --last-failed --last-failed-no-failures none tests/browser; }

# Two lanes, so that no processor waits for the end of a phase; the browser is not beside the unit tests, which use both
# processors. The seconds of each phase stand at the end.
test: venv
	@$(BIN)/python tests/support/phases.py "browser unit" "lint layers client-check types"

lint: venv
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

layers: venv
	$(BIN)/lint-imports

types: venv
	$(BIN)/python tests/support/course_code.py build/course
	$(BIN)/mypy
	$(BIN)/mypy build/course

# Without the code that explains each assertion, a third of the collection, and of a fresh checkout; what fails runs
# once more with it.
UNIT := $(BIN)/pytest --ignore tests/browser
unit: venv
	$(UNIT) -n 2 --dist worksteal --assert=plain || { $(UNIT) --last-failed --last-failed-no-failures none; exit 1; }

shapes: venv
	$(BIN)/pytest -n 2 --dist worksteal $$($(BIN)/python tests/support/engine_paths.py)

# Without PARTS all of them, in a share two that follow from SEED; without SEED it is the number of the commit.
campaigns: venv
	@PYTHONPATH=src:tests/support $(BIN)/python -m campaigns $(PARTS) $(if $(SEED),--seed $(SEED)) $(if $(SHARE),--share)

# Options as of `python -m kills --help`: make kills KILLS="--long --number 40"
kills: venv
	PYTHONPATH=src:tests/support $(BIN)/python -m kills $(KILLS)

# Options as of `python -m loom_cuts --help`: make cuts CUTS="--carpets 2 --runs 20"
cuts: venv
	PYTHONPATH=src:tests/support $(BIN)/python -m loom_cuts $(CUTS)

# Options as of `python -m mutants --help`: make mutants MUTANTS="--number 50 'ilmek.linkage.*'"
mutants: venv
	PYTHONPATH=src:tests/support $(BIN)/python -m mutants $(MUTANTS)

# Options as of `python -m fuzz --help`: make fuzz FUZZ="--only 1234", make fuzz FUZZ="out/fuzz/*.json"
fuzz: venv
	PYTHONPATH=src:tests/support $(BIN)/python -m fuzz $(FUZZ)

bench: venv
	$(BIN)/python -m benchmarks

docs: venv
	$(BIN)/sphinx-build -W --keep-going -q -b html docs docs/_build/html
	@echo "docs/_build/html/index.html"

# Another Python: make dist PYTHON=python3.13
# The wheel is built from the sdist. Its kernels are compiled in that time, once; the trial of the sdist leaves them out.
dist: $(BIN)/python
	rm -rf dist && $(PIP) install build && $(BIN)/python -m build --outdir dist .
	$(PYTHON) tests/support/tried_distribution.py dist constraints.txt examples

# Versions move only by this command; the file names no host.
lock:
	rm -rf .venv-lock && $(PYTHON) -m venv .venv-lock
	.venv-lock/bin/python -m pip install --quiet --upgrade '.[dev]'
	.venv-lock/bin/python -m pip freeze --exclude ilmek --exclude-editable > constraints.txt
	rm -rf .venv-lock
	cd studio && npm install --package-lock-only --omit-lockfile-registry-resolved --no-fund
	$(PYTHON) -c 'import json; p = "studio/package-lock.json"; d = json.load(open(p)); [v.pop("funding", None) for v in d["packages"].values()]; open(p, "w").write(json.dumps(d, indent=2) + "\n")'

clean:
	rm -rf .venv build dist studio/node_modules out docs/_build .pytest_cache .mypy_cache .ruff_cache .import_linter_cache
