# Every target is one line over a script that also runs on its own, so a machine
# without make loses nothing: README, "Commands".
PYTHON ?= python3
ifeq ($(OS),Windows_NT)
  PY := .venv/Scripts/python.exe
else
  PY := .venv/bin/python
endif
# What a shell sets for another Python, as ROS does, does not reach the kit's; the list
# is labkit/base/shell.py's. `make doctor` names what was set.
OTHERS := PYTHONPATH PYTHONHOME PYTHONPLATLIBDIR PYTHONEXECUTABLE PYTHONSAFEPATH \
  PYTHONINSPECT PYTHONSTARTUP PYTEST_PLUGINS PYTEST_ADDOPTS
export ROBO47_SHELL := $(strip $(foreach name,$(OTHERS),$(if $(value $(name)),$(name))) $(ROBO47_SHELL))
unexport $(OTHERS)
# The robot: MENAGERIE_ROOT where set, else mujoco_menagerie/ fetched once.
ROBOT := $(if $(MENAGERIE_ROOT),,mujoco_menagerie/PROVENANCE.json)
# Without DAY= a script takes the day that you worked on last.
ON_DAY = $(if $(DAY),--day $(DAY))
# A command of a day does not take WEEK= in silence.
OF_A_DAY = start watch hunt check hint borrow run view figures notebook docs author constants
ifeq ($(origin WEEK),command line)
  ifneq ($(filter $(OF_A_DAY),$(MAKECMDGOALS)),)
    $(error make $(firstword $(MAKECMDGOALS)) takes DAY=2, no WEEK=)
  endif
endif
ON_WEEK = $(WEEK) $(ON_DAY)
# "Not yet" is no error of make's. Scripts end with this code then, and without make
# with 1, which is what a Python ends with that cannot even start.
export ROBO47_NOT_YET := 75
NOT_YET = || { code=$$?; test $$code -eq $(ROBO47_NOT_YET) || exit $$code; }
# A picture needs no page in the browser.
VIEW := $(if $(findstring --screenshot,$(ARGS)),figures,view)

# A lab that draws gets what it draws with.
RUN = $(if $(shell grep -lE '^ *(import|from) (matplotlib|PIL)' w*/work/*.py 2>/dev/null),figures,core)

.DEFAULT_GOAL := help
VERBS := update edition start watch hunt check hint borrow run doctor bench kernels test-matrix setup robot view \
  grade capstone proof fresh help test catalogue soak report lint docs site oracle figures notebook new author gaps constants
.PHONY: $(VERBS)

help: ## list the commands; ALL=1 adds those for teachers and authors
	@echo "robo47: derive a result by hand, verify it against MuJoCo, record the number."
	@echo
	@sed -n 's/^\([a-z0-9%-]*\):.*##\([0-9]\) \(.*\)/\2  make \1|\3/p' Makefile | sort \
	  | cut -c2- | awk -F'|' '{printf "%-18s %s\n", $$1, $$2}'
ifdef ALL
	@echo
	@sed -n 's/^\([a-z0-9%-]*\):.*## \(.*\)/  make \1|\2/p' Makefile | sed 's/%/1/' \
	  | awk -F'|' '{printf "%-18s %s\n", $$1, $$2}'
else
	@echo "  make help ALL=1    list all others: the capstone, grading, writing a day"
endif
	@echo
	@echo "DAY=2 selects a day, WEEK=1 a week; without it, the last one you worked on."
	@echo "ARGS='...' passes options to the command: make day1 ARGS=--no-log"

day%: .venv/.ready-core $(ROBOT) ## set up, run the kit's complete lab of Day 1, check and log it
	@$(PY) scripts/run_day.py $* --kit $(ARGS)

week%: .venv/.ready-core $(ROBOT) ## run every lab of Week 1, print all numbers in one table
	@$(PY) scripts/run_week.py $* $(ARGS) $(NOT_YET)

capstone: .venv/.ready-$(if $(findstring .,$(ARGS)),figures,core) $(ROBOT) ## run the week's final task with your functions; ARGS=--all
	@$(PY) scripts/capstone.py $(ON_WEEK) $(ARGS) $(NOT_YET)

proof: .venv/.ready-view $(ROBOT) ## write a results page: your numbers, the capstone in 3D
	@$(PY) scripts/proof.py $(if $(WEEK),--week $(WEEK)) $(ON_DAY) $(ARGS) $(NOT_YET)

fresh: .venv/.ready-core $(ROBOT) ## test whether a clone of your last commit gives your numbers
	@$(PY) scripts/fresh.py $(ON_WEEK) $(ARGS) $(NOT_YET)

view: .venv/.ready-$(VIEW) $(ROBOT) ##6 see the arm, moved by your code; TASK=1.4: a call that fails
	@$(PY) scripts/view_panda.py $(DAY) $(if $(TASK),--task $(TASK)) $(ARGS)

start: .venv/.ready-core ##0 write your copy of a day's lab; RESET=1.4 empties one task
	@$(PY) scripts/start_day.py $(DAY) $(if $(RESET),--reset $(RESET)) $(ARGS)

check: .venv/.ready-core $(ROBOT) ##2 check your day, or one task with TASK=1.4
	@$(PY) scripts/check_day.py $(DAY) $(if $(TASK),--task $(TASK)) $(ARGS) $(NOT_YET)

watch: .venv/.ready-core $(ROBOT) ##1 check at each save, in a loop; keys for hint, run and view
	@$(PY) scripts/watch_day.py $(DAY) $(if $(TASK),--task $(TASK)) $(ARGS) $(NOT_YET)

hunt: .venv/.ready-core $(ROBOT) ##8 find the mistake in an otherwise correct lab; LEVEL=2 SEED=7
	@$(PY) scripts/hunt_bug.py $(DAY) $(if $(LEVEL),--level $(LEVEL)) $(if $(SEED),--seed $(SEED)) $(ARGS) $(NOT_YET)

hint: .venv/.ready-core $(ROBOT) ##3 get the next hint, for TASK=1.4 or for the next open task
	@$(PY) scripts/hint.py $(TASK) $(ON_DAY) $(ARGS) $(NOT_YET)

borrow: .venv/.ready-core $(ROBOT) ##4 use the kit's function of TASK=1.4, and write yours later
	@$(PY) scripts/borrow.py $(TASK) $(ON_DAY) $(ARGS)

run: .venv/.ready-$(RUN) $(ROBOT) ##5 run your lab and log its numbers
	@$(PY) scripts/run_day.py $(DAY) $(ARGS) $(NOT_YET)

update: .venv/.ready-core ##9 get the kit's newest version, keep your work; FROM=URL
	@$(PY) scripts/update.py $(if $(FROM),--from $(FROM)) $(if $(TO),--to $(TO)) $(ARGS)

doctor: ## test this machine; paste the output when you ask for help
	@$(PYTHON) scripts/doctor.py $(ARGS) $(NOT_YET)

grade: .venv/.ready-$(if $(findstring --dask,$(ARGS)),grade,$(if $(findstring --proof,$(ARGS)),view,core)) $(ROBOT) ## grade a folder of clones: make grade ROOT=../class
	@$(PY) scripts/grade_class.py "$(or $(ROOT),$(error which folder of \
	clones? make grade ROOT=../class))" $(if $(WEEK),--week $(WEEK)) $(ON_DAY) \
	$(if $(SEED),--hunt $(or $(LEVEL),1) --seed $(SEED)) $(ARGS)

edition: .venv/.ready-core ## write the student edition, solutions sealed: OUT=../students
	@$(PY) scripts/edition.py "$(or $(OUT),$(error where to? make edition OUT=../robo47-students))" $(ARGS)

test: .venv/.ready-test $(ROBOT) ## set up and run the tests
	@$(PY) -m pytest $(or $(ARGS),-n 2 --dist worksteal)

catalogue: .venv/.ready-test $(ROBOT) ## test the days that changed wholly, and record it: before a commit
	@$(PY) tests/whole.py $(DAY) $(ARGS)

soak: .venv/.ready-test ## run the long tests: a log of gigabytes, a class of 200
	@$(PY) -m pytest -m soak -s $(ARGS)

report: .venv/.ready-core ##7 write metrics/report.html from the log; WEEK=1: one week
	@$(PY) scripts/report_metrics.py $(if $(WEEK),--week $(WEEK)) $(ON_DAY) $(ARGS)

kernels: .venv/.ready-test $(ROBOT) ## run the tests of numbers as on other processors
	@$(PY) scripts/kernels.py $(ARGS)

test-matrix: .venv/.ready-test $(ROBOT) ## run the tests on the oldest and newest MuJoCo and Python
	@$(PY) scripts/test_matrix.py $(ARGS)

lint: .venv/.ready-test ## check style, format and types
	@$(PY) -m ruff check . && $(PY) -m ruff format --check . && $(PY) -m mypy

docs: .venv/.ready-core $(ROBOT) ## insert fresh outputs into the documents
	@$(PY) scripts/build_docs.py $(ON_DAY) $(ARGS)

site: .venv/.ready-site .venv/.ready-notebook $(ROBOT) site/node_modules/.package-lock.json ## build the course as a site, in _site/ (needs Node.js)
	@$(PY) scripts/build_site.py $(ARGS)

site/node_modules/.package-lock.json: site/package-lock.json
	@npm ci --prefix site --no-audit --no-fund --loglevel=error
	@touch $@

figures: .venv/.ready-figures $(ROBOT) ## draw the day's figure with your functions
	@$(PY) scripts/make_figures.py $(ON_DAY) $(ARGS)

notebook: .venv/.ready-notebook $(ROBOT) ## write a day as a notebook: guide, your functions, verdicts
	@$(PY) scripts/make_notebook.py $(ON_DAY) $(ARGS)

new: .venv/.ready-core $(ROBOT) ## write a day's skeleton: DAY=8 WEEK=w2-autonomy NAME=me
	@$(PY) scripts/new_day.py "$(or $(DAY),$(error which day? make new DAY=8 \
	WEEK=w2-autonomy NAME=my_day))" "$(WEEK)" "$(NAME)" $(if $(FROM),--from $(FROM)) $(ARGS)

author: .venv/.ready-test .venv/.ready-notebook .venv/.ready-view $(ROBOT) ## validate a day that you are writing; TASK=9.3: one function
	@$(PY) scripts/author_day.py $(DAY) $(if $(TASK),--task $(TASK)) $(ARGS) $(NOT_YET)

constants: .venv/.ready-core $(ROBOT) ## sensitivity: double each constant behind a guide's numbers
	@$(PY) scripts/constants.py $(DAY) $(ARGS) $(NOT_YET)

gaps: .venv/.ready-core $(ROBOT) ## mutation test: changes of functions that no question detects
	@$(PY) scripts/gaps.py $(DAY) $(ARGS) $(NOT_YET)

oracle: .venv/.ready-core ## regenerate tests/data with Pinocchio (own environment)
	@$(PY) scripts/make_oracle.py $(ARGS)

bench: .venv-bench/.ready-bench $(ROBOT) ## measure the speed next to other tools, in .venv-bench
	@.venv-bench/$(PY:.venv/%=%) scripts/bench.py $(ARGS)

.venv-bench/.ready-bench: pyproject.toml constraints.txt
	@$(PYTHON) scripts/setup_env.py --venv .venv-bench bench

robot: .venv/.ready-core ## download the robot, if there was no network before
	@$(PY) scripts/fetch_menagerie.py $(ARGS)

setup: ## make .venv again, if it is broken
	@$(PYTHON) scripts/setup_env.py --anew

# PYTHON=... on the command line: set-up says so where .venv has another one.
.venv/.ready-%: pyproject.toml constraints.txt $(PY) $(if $(filter command%,$(origin PYTHON)),said)
	@$(PYTHON) scripts/setup_env.py $*

.PHONY: said
said:

# No recipe: a .venv whose Python is gone makes the line above run.
$(PY):

# A student without a network still gets a lab: the embedded twin is used.
mujoco_menagerie/PROVENANCE.json: | .venv/.ready-core
	@$(PY) scripts/fetch_menagerie.py --daily || true

# A goal that is no command.
NEAR = import difflib, sys; goal, verbs = sys.argv[1], sys.argv[2].split(); \
  near = difflib.get_close_matches(goal, verbs + ["day1", "week1"], 1); \
  sys.exit("error: make " + goal + " is no command of the kit. " \
  + ("Do you mean make " + near[0] + "?" if near else "All commands: make help"))
.DEFAULT:
	@$(PYTHON) -c '$(NEAR)' '$@' '$(VERBS)'
