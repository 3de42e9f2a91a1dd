# Stiff normal contact in FreeFEM: set-up, runs, figures and checks. `make` lists the targets.

SCENE  ?= disc-on-block
ARGS   ?=
TESTS  ?= tests
NP     :=
PYTEST_ARGS ?=

# One thread: runs are compared by CPU seconds, and the tests already use every core.
export OPENBLAS_NUM_THREADS := 1
# Numbers with a point, whatever the user's language.
export LC_ALL := C

# What is made: in this folder, or in the cache if there is one (CONTACT_CACHE, or this folder cannot be written); results
# where make RESULTS=folder says. The runs are told of both by the environment.
RESULTS ?= $(or $(CONTACT_RESULTS),results)
CACHE   := $(shell sh edp/input/cache.sh 0 .)
ifneq ($(word 2,$(CACHE)),)
$(error the cache $(CACHE): make knows no folder with a blank in its name; allowed: CONTACT_CACHE=folder without blanks)
endif
CACHE   := $(abspath $(CACHE))
VENV    := $(if $(CACHE),$(CACHE)/venv,.venv)
BUILD   := $(if $(CACHE),$(CACHE)/build,build)
PYTHON  := $(VENV)/bin/python
POST    := $(PYTHON) -m postprocess
# The plugins, by the names that the modules ask for: of another version's build/ they find none.
FAST      := $(BUILD)/$(notdir $(wildcard edp/input/without/fast-plugin-*.idp))
MULTIGRID := $(BUILD)/$(notdir $(wildcard edp/input/without/multigrid-plugin-*.idp))
# A plugin in the cache is named by a .freefem++.pref there: of FreeFEM's lists only HOME's come before this folder's.
FREEFEM := $(if $(CACHE),env HOME=$(BUILD) )FreeFem++ -nw -v 0
ifneq ($(RESULTS),results)
export CONTACT_RESULTS := $(RESULTS)
endif
ifneq ($(CACHE),)
export CONTACT_CACHE := $(CACHE)
export CONTACT_POSTPROCESS := $(POST)
endif

SCENES  := $(sort disc-on-block $(basename $(notdir $(filter-out %/two-bodies.edp,$(wildcard edp/scenes/*.edp)))))
SCRIPT  := $(if $(filter disc-on-block,$(SCENE)),edp/main.edp,edp/scenes/$(SCENE).edp)
ifeq ($(filter $(SCENES),$(SCENE)),)
$(error unknown scene "$(SCENE)"; the scenes are: $(SCENES))
endif
CAMPAIGNS := bench bench-large bench-ranks bench-peers stability friction coverage conditioning models plasticity mutants \
  verification tables choice

.DEFAULT_GOAL := help
.PHONY: help paper paper-run setup system reader python new install uninstall fast try-fast mpi petsc tools run movie \
  figures pictures report $(CAMPAIGNS) labs kit notebooks page site check-lab test test-long test-all test-systems lint \
  pages uses numbers doctor clean distclean force

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))
	@echo 'Scenes: $(SCENES)'

# ---------------------------------------------------------------- set-up: postprocess/setup.sh
QUIET := -s --no-print-directory
SETUP := VENV='$(VENV)' BUILD='$(BUILD)' CACHE='$(CACHE)' sh postprocess/setup.sh

setup: $(VENV)/dev.stamp try-fast | system reader ## install what is missing: FreeFEM, gmsh, Python packages in .venv
reader: | system
system reader:
	@$(SETUP) $@
$(VENV)/run.stamp: requirements.txt | system
	@$(SETUP) python && touch $@
$(VENV)/dev.stamp: requirements-dev.txt $(VENV)/run.stamp | system reader
	@$(SETUP) develop && touch $@
$(VENV)-peers/run.stamp: requirements-peers.txt | system
	@$(SETUP) peers && touch $@

# Runs need no Python, the pictures of them do: what cannot be had now is no reason not to run.
python: | system
	@test -e $(VENV)/run.stamp || PIP_RETRIES=1 $(MAKE) $(QUIET) $(VENV)/run.stamp || \
	  echo 'no Python for the pictures: make setup says more'
fast: | system ## build the plugin that assembles and sorts matrices faster, where there is a compiler
	@$(MAKE) $(QUIET) $(FAST)
try-fast: | system
	@! $(SETUP) can_compile || $(MAKE) $(QUIET) $(FAST) >/dev/null 2>&1 || \
	  echo 'the plugin of make fast could not be built ($(BUILD)/fast.log): runs go on without it'
# FreeFEM's program is a prerequisite: a plugin is of one version.
$(FAST): edp/solver/plugins/fast.cpp $(wildcard /usr/bin/FreeFem++)
	@$(SETUP) fast $(@:.idp=) $<
# Debian's PETSc, or the one in $(PETSC), which has include/ and lib/ (named on the command line, or the variables
# PETSC_DIR/PETSC_ARCH of a PETSc of one's own).
PETSC = $(firstword $(if $(PETSC_DIR),$(PETSC_DIR)/$(PETSC_ARCH)) $(wildcard /usr/lib/petscdir/petsc*/*-linux-gnu-real))
mpi: | petsc ## build the plugin for -solver multigrid and several processes: make mpi [PETSC=/its/folder]
	@$(MAKE) $(QUIET) $(MULTIGRID)
petsc: | system
	@$(SETUP) petsc '$(PETSC)'
$(MULTIGRID): edp/solver/plugins/multigrid.cpp $(wildcard edp/solver/plugins/multigrid-*.hpp) postprocess/setup.sh
	@$(SETUP) multigrid $(@:.idp=) '$(PETSC)' $(filter-out %.sh,$^)
tools: mpi $(VENV)-peers/run.stamp | system ## install what some tests are skipped without: PETSc, NGSolve, CalculiX, Chromium
	@$(SETUP) tools
PREFIX ?= /usr/local
NAME   := stiff-contact
export PREFIX DESTDIR
install: ## put scripts, Python commands and the starter stiff-contact below PREFIX: make install [PREFIX=/usr/local]
	@$(if $(findstring $$,$(value PREFIX)$(value DESTDIR)),\
	  echo 'PREFIX or DESTDIR: a dollar sign; make would replace it; allowed: a whole path without'; exit 10,:)
	@$(SETUP) install $(NAME) $(MULTIGRID:.idp=) $(FAST:.idp=)
uninstall: ## remove what make install has put below PREFIX
	@$(SETUP) uninstall $(NAME)
new: ## begin a law, a scene or a method of your own outside this folder: make new DIR=folder
	@$(SETUP) new '$(DIR)'
doctor: ## say what is installed, what is missing and how to get it
	@sh postprocess/setup.sh doctor

# ---------------------------------------------------------------- runs
# NP=2: on two processes. Open MPI 4 and 5 want to be told that it may run as root, with more processes than cores.
MPI := OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
  OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
RUN_ONE  = $(if $(findstring -plot 1,$(ARGS)),$(FREEFEM:-nw=),$(FREEFEM)) $(SCRIPT) $(ARGS)
RUN_MANY = $(MPI) mpiexec -n $(NP) $(subst FreeFem++,FreeFem++-mpi,$(FREEFEM)) $(SCRIPT) -solver multigrid $(ARGS)
run: | system python $(if $(NP),mpi) ## run a scene: make run [SCENE=name] [ARGS="-kappa 1e6"] [NP=processes, in space]
	@$(if $(NP),$(RUN_MANY),$(RUN_ONE)); code=$$?; \
	case $$code in 0) exit 0;; 10) why='refused input';; 20) why='not converged';; 21) why='accuracy not reached';; \
	  30) why='out of memory or disk';; *) why='failed';; esac; \
	echo "FreeFem++ ended with code $$code: $$why"; exit $$code
# Code 20, not converged: the steps are there, and worth seeing.
MOVIE := $(RESULTS)/movies/$(SCENE)
movie: $(VENV)/run.stamp | system ## show the method at work: make movie [SCENE=name] [ARGS="-method paper -h 0.5"]
	@$(FREEFEM) $(SCRIPT) $(ARGS) -states 1 -out $(MOVIE); code=$$?; \
	case $$code in 0|20) ;; *) echo "FreeFem++ ended with code $$code: no movie"; exit $$code;; esac; \
	$(POST) movie --out $(MOVIE) $(MOVIE) && exit $$code

# ---------------------------------------------------------------- figures, with their runs: postprocess/figures.toml
MAKES = $(POST) make --freefem '$(FREEFEM)' --out $(RESULTS)
figures: $(VENV)/run.stamp | system ## draw every figure into results/figures/, with the runs that it needs
	@$(MAKES) figures
$(RESULTS)/figures/%: $(VENV)/run.stamp force | system
	@$(MAKES) figures $*
paper-run: | system
	@$(FREEFEM) edp/main.edp -method paper -order 1 -h 0.5
paper: paper-run $(VENV)/run.stamp ## the paper's test by its scheme: 3 adaptations, 12 Newton steps, its figures and claims
	@$(MAKES) paper --expect && $(MAKES) figures figure1 figure2 && $(MAKES) paper
	@$(POST) paper $(RESULTS)/paper --figures $(RESULTS)/figures --out $(RESULTS)/paper/claims.html
report: $(VENV)/run.stamp | system ## one page of everything that has been run, with errors against run times: results/report/
	@$(MAKES) accuracy && echo 'report: some seconds' && $(POST) report --out $(RESULTS)/report/index.html $(RESULTS)
pictures: $(VENV)/run.stamp | system ## draw the small pictures of the pages anew
	@$(MAKES) figures figure1 sphere
	@PYTHON=$(PYTHON) RESULTS=$(RESULTS) MAKE='$(MAKE)' sh tests/campaigns/page_pictures.sh

# ---------------------------------------------------------------- campaigns: many runs, a row each; begun again, they go on
bench: ## error against run time, cost growth, ingredients, timed one run at a time
bench-large: | mpi ## sizes in space up to three million unknowns with -solver multigrid: 8 GB, an hour
bench-ranks: | mpi ## memory and answers of one, two and four processes, with lean levels too
bench-peers: $(VENV)-peers/run.stamp | reader ## the same tests by NGSolve, in turns with the package; parts by CalculiX
stability: ## counts and failures over laws, stiffness, meshes, loads and friction
friction: ## the part of make stability with friction: paths of loads that a seed draws
coverage: | reader ## whether the estimates of the error hold, over scenes and parts that a seed draws
conditioning: ## condition of plain Newton's tangent and its steps
models: ## walls, tangents, plain Newton and xnewton on 75 problems and two meshes
plasticity: | reader ## 48 problems of plastic bodies, hardness, first yield; CalculiX if it is there
mutants: $(VENV)/dev.stamp ## small errors planted in the scripts, and which no test sees: make mutants [COUNT=200]
verification: $(VENV)/dev.stamp ## solve published benchmarks, and write their numbers into tests/VERIFICATION.md
tables: ## write the campaigns' results into the tables of tests/RESULTS.md and tests/COST.md
choice: $(VENV)/dev.stamp ## find for an hour what each test costs and reaches, and choose the quick tests anew
$(CAMPAIGNS): $(VENV)/run.stamp | system
	@PYTHON=$(PYTHON) RESULTS=$(RESULTS) MPI='$(MPI)' sh tests/campaigns/campaign.sh $@ $(COUNT) $(if $(PARTIAL),--partial)

# ---------------------------------------------------------------- labs and pages
labs: $(VENV)/run.stamp | system reader ## run every command of the labs (edp/labs), with their figures, into results/labs/
	@RESULTS=$(RESULTS) VENV=$(VENV) sh tests/campaigns/labs.sh
# The run of lab 3 is the film of the slides.
kit: $(VENV)/run.stamp | system reader ## the teaching kit: slides, notes, handouts, expected values, lab 0 without gmsh
	@$(FREEFEM) edp/labs/3-threshold/threshold.edp -h 0.25 -vtu 0 -estimate 0 -out $(RESULTS)/labs/kit-film >/dev/null
	@$(POST) kit $(RESULTS)/labs/kit-film --out $(RESULTS)/kit
notebooks: $(VENV)/dev.stamp | system reader ## each lab as a notebook for Jupyter, executed, into results/notebooks/
	@$(POST) notebooks --execute --out $(RESULTS)/notebooks
page: $(VENV)/run.stamp | system ## one HTML page that needs nothing installed: Algorithm 1 step by step, into results/page/
	@$(POST) play --out $(RESULTS)/page/algorithm1.html
site: $(VENV)/dev.stamp ## all pages as a site to search, without the labs' answers: make site [TEACHER=1], into results/site/
	@PYTHONPATH=. $(PYTHON) tests/documents.py $(if $(TEACHER),--answers) --notebooks $(RESULTS)/notebooks --out $(RESULTS)/site

# make check-lab 2 ANSWERS=file: the lab's number is no target of its own.
LABS    := 0 1 2 3 4 5 6 7 8 9 10 11 12
N       ?= $(filter $(LABS),$(MAKECMDGOALS))
ANSWERS ?= answers.csv
check-lab: $(VENV)/run.stamp ## check a student's answers: make check-lab 2 ANSWERS=answers.csv, check-lab 4 ANSWERS=mylaw.idp
	@$(POST) check_lab $(or $(N),none) '$(ANSWERS)'
ifneq ($(filter check-lab,$(MAKECMDGOALS)),)
.PHONY: $(LABS)
$(LABS): ; @:
endif

# ---------------------------------------------------------------- checks
# Where PETSc is, the plugin is built, and tested; where not, its tests are skipped. Which tests are not quick:
# tests/long.txt, and tests/nightly.txt for the dearest, which only test-all runs.
test: ## run the quick tests: make test [TESTS=tests/test_x.py] [PYTEST_ARGS=-v]
test-long: ## run the other tests of .ci/run
test-all: ## run every test there is
test:      WHICH := not long
test-long: WHICH := long and not nightly
test-all:  WHICH := long or not long
test test-long test-all: $(VENV)/dev.stamp | system
	@test -z "$(PETSC)" || ! command -v mpicxx >/dev/null || $(MAKE) $(QUIET) $(MULTIGRID)
	@PYTHONDONTWRITEBYTECODE= $(PYTHON) tests/run.py '$(WHICH)' $(PYTEST_ARGS) $(TESTS)
# As root, with debootstrap. CONTACT_SYSTEMS=folder keeps the trees; SYSTEMS="trixie noble" chooses.
test-systems: | system ## in bare Debian 12, Debian 13, Ubuntu 24.04: the README's commands, make test, the same numbers
	@PYTEST_ARGS='$(PYTEST_ARGS)' TESTS='$(TESTS)' $(SETUP) interpreter tests/systems.py $(SYSTEMS)

lint: $(VENV)/dev.stamp ## check the style of the Python and FreeFEM sources
	@$(PYTHON) -m ruff check postprocess tests edp/input
	@$(PYTHON) -m ruff format --check postprocess tests edp/input
	@$(PYTHON) -m mypy
	@$(PYTHON) tests/lint_edp.py edp
pages: ## write the pages' tables from heads, -help, a few short runs and a case file's grammar
uses: MODULE ?= solver/problem/problem.idp
uses: ## print which names MODULE (solver/problem/problem.idp, say) uses of which others, and who uses it
pages uses: $(VENV)/run.stamp | system
	@PYTHONPATH=.:tests:edp/input $(PYTHON) tests/pages.py $(if $(filter uses,$@),$(MODULE))
numbers: pages $(VENV)/dev.stamp | system ## run the commands of the pages' numbers anew, write those that have changed, show them
	@for made in page_numbers screens campaigns/newton_step; do \
	  PYTHONPATH=.:tests:tests/campaigns $(PYTHON) tests/$$made.py || exit 1; done
clean: ## remove results and generated meshes
	rm -rf results meshes/generated $(patsubst %/.shared,%,$(wildcard $(CACHE:%=%/meshes/.shared)))
distclean: clean ## remove the virtual environment and caches as well
	rm -rf $(dir $(wildcard $(VENV)/run.stamp $(VENV)-peers/run.stamp $(BUILD)/multigrid.log $(BUILD)/fast.log)) \
	  .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
