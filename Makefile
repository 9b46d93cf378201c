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
.PHONY: start check hint run doctor bench test-matrix setup view grade
.PHONY: help day1 test soak report lint docs oracle figures notebook

help: ## this list
	@echo "robo47: derive it by hand, verify it against MuJoCo, record the number."
	@echo
	@sed -n 's/^\([a-z0-9-]*\):.*## \(.*\)/  make \1|\2/p' Makefile | awk -F'|' '{printf "%-22s %s\n", $$1, $$2}'
	@echo
	@echo "Add ARGS='...' to pass options on: make day1 ARGS=--no-log"

day1: .venv/.ready-core $(ROBOT) ## set up, run the Day 1 lab, verify it, log it
	@$(PY) w1-foundations/src/day1_transforms.py $(ARGS)

view: .venv/.ready-view $(ROBOT) ## the arm, its frames and the proof; ARGS=--web: in a browser
	@$(PY) scripts/view_panda.py $(ARGS)

start: .venv/.ready-core ## write your copy of DAY=1's lab; RESET=1.4 empties a task
	@$(PY) scripts/start_day.py $(DAY) $(if $(RESET),--reset $(RESET)) $(ARGS)

check: .venv/.ready-core $(ROBOT) ## check DAY=1, or TASK=1.4 alone; ARGS=--watch
	@$(PY) scripts/check_day.py $(DAY) $(if $(TASK),--task $(TASK)) $(ARGS)

hint: .venv/.ready-core $(ROBOT) ## the next hint, for TASK=1.4 or for what is next
	@$(PY) scripts/hint.py $(TASK) --day $(DAY) $(ARGS)

run: .venv/.ready-core $(ROBOT) ## run your own copy of DAY=1's lab, log its numbers
	@$(PY) $(or $(wildcard w*/work/day$(DAY)_*.py),$(error no lab of yours \
	yet; first: make start DAY=$(DAY))) $(ARGS)

doctor: ## what this machine has and lacks; paste it when asking
	@$(PYTHON) scripts/doctor.py $(ARGS)

grade: .venv/.ready-$(if $(findstring --dask,$(ARGS)),grade,core) $(ROBOT) ## grade a folder of clones: make grade ROOT=../class
	@$(PY) scripts/grade_class.py "$(or $(ROOT),$(error which folder of \
	clones? make grade ROOT=../class))" --day $(DAY) $(ARGS)

test: .venv/.ready-test $(ROBOT) ## set up and run the tests
	@$(PY) -m pytest $(ARGS)

soak: .venv/.ready-test ## the long tests: a log of gigabytes, a class of 200
	@$(PY) -m pytest -m soak -s $(ARGS)

report: .venv/.ready-report ## metrics/report.html and report.png from the log
	@$(PY) scripts/report_metrics.py $(ARGS)

test-matrix: .venv/.ready-test $(ROBOT) ## the tests on the oldest and newest MuJoCo and Python
	@$(PY) scripts/test_matrix.py $(ARGS)

lint: .venv/.ready-test ## style, format and types
	@$(PY) -m ruff check . && $(PY) -m ruff format --check . && $(PY) -m mypy

docs: .venv/.ready-core $(ROBOT) ## insert fresh outputs into the documents
	@$(PY) scripts/build_docs.py $(ARGS)

figures: .venv/.ready-figures $(ROBOT) ## draw the pictures of the lessons
	@$(PY) scripts/make_figures.py $(ARGS)

notebook: .venv/.ready-notebook $(ROBOT) ## turn the lab script into a notebook
	@$(PY) scripts/make_notebook.py $(ARGS)

oracle: .venv/.ready-core ## regenerate tests/data from Pinocchio (own environment)
	@$(PY) scripts/make_oracle.py $(ARGS)

bench: .venv-bench/.ready-bench $(ROBOT) ## measure it beside other tools, in its own .venv-bench
	@.venv-bench/$(PY:.venv/%=%) scripts/bench.py $(ARGS)

.venv-bench/.ready-bench: pyproject.toml constraints.txt
	@$(PYTHON) scripts/setup_env.py --venv .venv-bench bench

setup: ## make .venv anew, when it is broken
	@$(PYTHON) scripts/setup_env.py --anew

.venv/.ready-%: pyproject.toml constraints.txt $(PY)
	@$(PYTHON) scripts/setup_env.py $*

# No recipe: a .venv whose Python is gone makes the line above run.
$(PY):

# A student without a network still gets a lab: the embedded twin stands in.
mujoco_menagerie/PROVENANCE.json: | .venv/.ready-core
	@$(PY) scripts/fetch_menagerie.py || true
