# Every target is one line over a script that also runs on its own, so a machine
# without make loses nothing: python3 scripts/setup_env.py, then the line below.
PYTHON ?= python3
DAY ?= 1
ifeq ($(OS),Windows_NT)
  PY := .venv/Scripts/python.exe
else
  PY := .venv/bin/python
endif
# The robot: MENAGERIE_ROOT where set, else mujoco_menagerie/ fetched once.
ROBOT := $(if $(MENAGERIE_ROOT),,mujoco_menagerie/PROVENANCE.json)

.DEFAULT_GOAL := help
.PHONY: help day1 view test soak report lint docs oracle

help: ## this list
	@echo "robo47: derive it by hand, verify it against MuJoCo, record the number."
	@echo
	@sed -n 's/^\([a-z0-9-]*\):.*## \(.*\)/  make \1|\2/p' Makefile | awk -F'|' '{printf "%-22s %s\n", $$1, $$2}'
	@echo
	@echo "Add ARGS='...' to pass options on: make day1 ARGS=--no-log"

day1: .venv/.ready-core $(ROBOT) ## set up, run the Day 1 lab, verify it, log it
	@$(PY) w1-foundations/src/day1_transforms.py $(ARGS)

view: .venv/.ready-view $(ROBOT) ## look at the arm and its frames, in a window or a browser
	@$(PY) scripts/view_panda.py $(ARGS)

test: .venv/.ready-test $(ROBOT) ## set up and run the tests
	@$(PY) -m pytest $(ARGS)

soak: .venv/.ready-test ## the long tests of the metrics log, some minutes
	@$(PY) -m pytest -m soak -s $(ARGS)

report: .venv/.ready-report ## metrics/report.html and report.png from the log
	@$(PY) scripts/report_metrics.py $(ARGS)

lint: .venv/.ready-test ## style, format and types
	@$(PY) -m ruff check . && $(PY) -m ruff format --check . && $(PY) -m mypy

docs: .venv/.ready-core $(ROBOT) ## insert fresh outputs into the documents
	@$(PY) scripts/build_docs.py $(ARGS)

oracle: .venv/.ready-core ## regenerate tests/data from Pinocchio (own environment)
	@$(PY) scripts/make_oracle.py $(ARGS)

.venv/.ready-%: pyproject.toml constraints.txt
	@$(PYTHON) scripts/setup_env.py $*

# A student without a network still gets a lab: the embedded twin stands in.
mujoco_menagerie/PROVENANCE.json: | .venv/.ready-core
	@$(PY) scripts/fetch_menagerie.py || true
