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

# What is made: in this folder, or in the cache if there is one (CONTACT_CACHE, or this folder cannot be written); results where
# make RESULTS=folder says. The runs are told of both by the environment.
RESULTS ?= $(or $(CONTACT_RESULTS),results)
CACHE   := $(shell sh edp/case/cache.sh 0 .)
ifneq ($(word 2,$(CACHE)),)
$(error the cache $(CACHE): make knows no folder with a blank in its name; allowed: CONTACT_CACHE=folder without blanks)
endif
CACHE   := $(abspath $(CACHE))
VENV    := $(if $(CACHE),$(CACHE)/venv,.venv)
BUILD   := $(if $(CACHE),$(CACHE)/build,build)
PYTHON  := $(VENV)/bin/python
# The plugins, by the names that the modules ask for: of another version's build/ they find none.
FAST      := $(BUILD)/$(notdir $(wildcard edp/case/without/fast-plugin-*.idp))
MULTIGRID := $(BUILD)/$(notdir $(wildcard edp/case/without/multigrid-plugin-*.idp))
# A plugin in the cache is named by a .freefem++.pref there: of FreeFEM's lists only those of HOME's come before this folder's.
FREEFEM := $(if $(CACHE),env HOME=$(BUILD) )FreeFem++ -nw -v 0
ifneq ($(RESULTS),results)
export CONTACT_RESULTS := $(RESULTS)
endif
ifneq ($(CACHE),)
export CONTACT_CACHE := $(CACHE)
export CONTACT_POSTPROCESS := $(PYTHON) -m postprocess
endif

SCENES  := $(sort disc-on-block $(patsubst edp/scenes/%.edp,%,$(filter-out %/two-bodies.edp,$(wildcard edp/scenes/*.edp))))
SOURCES := $(shell find edp -name '*.idp' -o -name '*.sh' -o -name '*.py' -o -name '*.txt' 2>/dev/null) $(wildcard meshes/*.geo)
SCRIPT  := $(if $(filter disc-on-block,$(SCENE)),edp/main.edp,edp/scenes/$(SCENE).edp)

ifeq ($(filter $(SCENES),$(SCENE)),)
$(error unknown scene "$(SCENE)"; the scenes are: $(SCENES))
endif

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SECONDEXPANSION:
.PHONY: help paper paper-run setup system reader python new install uninstall fast try-fast mpi petsc tools run figures pictures movie report bench bench-large bench-ranks bench-peers stability friction coverage verification conditioning models plasticity mutants tables labs kit notebooks page site check-lab choice test test-long test-all test-systems lint pages numbers doctor clean distclean

# ---------------------------------------------------------------- the paper

PAPER := $(RESULTS)/figures/figure1.pdf $(RESULTS)/figures/figure2.pdf
PAPER_RUNS := $(foreach h,1 0.5 0.25 0.1,h-$(h) h-$(h)-d0) newton stiff stiff-d0 stiff-newton \
	$(foreach tol,2 4 8 10 12,tol-1e-$(tol)) eps-1e-1 eps-1e-2
paper: paper-run $(PAPER) ## the paper's test by its scheme, 3 adaptations and 12 Newton steps, its two figures, its claims on one page
	@echo 'figures: $(PAPER)'
	@for run in $(PAPER_RUNS); do \
	  flags=$$(echo "-$$run" | sed 's/-h-\([0-9.]*\)/ -h \1/;s/-\(tol\|eps\)-\(.*\)/ -\1 \2/;s/-stiff/ -kappa 1e12/;s/-d0/ -T0 d0/;s/-newton/ -method newton/'); \
	  case $$flags in *newton*) ;; *) flags="-method paper $$flags";; esac; \
	  case $$flags in *-h*) ;; *) flags="-h 0.5 $$flags";; esac; \
	  $(FREEFEM) edp/main.edp -order 1 $$flags -vtu 0 -estimate 0 -out $(RESULTS)/paper/$$run >/dev/null || exit 1; \
	done
	@test ! -e $(PYTHON) || $(PYTHON) -m postprocess paper $(RESULTS)/paper --figures $(RESULTS)/figures --out $(RESULTS)/paper/claims.html

paper-run: | system
	@$(FREEFEM) edp/main.edp -method paper -order 1 -h 0.5

help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))
	@echo 'Scenes: $(SCENES)'

# ---------------------------------------------------------------- set-up

FREEFEM_PACKAGES := freefem++ libfreefem++ libfreefem++-dev libopenblas0-pthread
# The first Python that is new enough and has packages of its own within the bounds of requirements.txt; else the first that can
# make virtual environments with pip in them (Debian's needs a package for that).
FIND_PYTHON := for found in own venv none; do for python in python3 /usr/bin/python3; do \
	  $$python postprocess/doctor.py --can $$found 2>/dev/null && break 2; \
	done; done; test $$found != none

define PIP_INSTALL
echo "Installing $< into $(VENV)"; \
	pip='$(PYTHON) -m pip install -q --no-input --disable-pip-version-check -r $<'; \
	$$pip || { sleep 5; $$pip; }
endef

setup: $(VENV)/dev.stamp try-fast | system reader ## install what is missing: FreeFEM, gmsh, Python packages in .venv

# Installs the Debian packages in $$missing, if any. A failed update is no reason to stop: the lists may be good enough, and if
# not, the install fails.
define INSTALL_MISSING
test -n "$$missing" || exit 0; \
	if [ "$$(id -u)" = 0 ]; then sudo=; else sudo='sudo -n'; fi; \
	if ! command -v apt-get >/dev/null || ! $$sudo true 2>/dev/null; then \
	  echo "Please install:$$missing (Debian's names; there is no apt-get here, or no right to use it)"; exit 1; \
	fi; \
	echo "Installing:$$missing"; \
	for pause in 0 5 30; do \
	  sleep $$pause; \
	  $$sudo apt-get -q update </dev/null; \
	  $$sudo env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends \
	    -o DPkg::Lock::Timeout=300 install $$missing </dev/null && exit 0; \
	done; \
	echo "apt-get could not install:$$missing"; exit 1
endef

# A FreeFem++ that is not Debian's brings its own plugins: Debian's packages are not asked for beside it.
system:
	@has() { dpkg-query -W -f '$${Status}' $$1 2>/dev/null | grep -q ' installed$$'; }; \
	missing=; \
	if ! command -v FreeFem++ >/dev/null; then missing=' $(FREEFEM_PACKAGES)'; \
	elif has freefem++; then for package in $(FREEFEM_PACKAGES); do has $$package || missing="$$missing $$package"; done; fi; \
	command -v gmsh >/dev/null || missing="$$missing gmsh"; \
	{ $(FIND_PYTHON); } || missing="$$missing python3 python3-venv"; \
	$(INSTALL_MISSING)

# Cases are read by Python with numpy and gmsh's module: Debian's packages, else the release of the program gmsh from PyPI.
CASES_READ = sh edp/case/read.sh 0 ready >/dev/null 2>&1
reader: | system
	@! $(CASES_READ) || exit 0; \
	( missing=' python3-numpy python3-gmsh'; $(INSTALL_MISSING) ) && $(CASES_READ) && exit 0; \
	$(MAKE) -s --no-print-directory $(VENV)/run.stamp && $(PYTHON) -m pip install -q --no-input --disable-pip-version-check \
	  "gmsh==$$(gmsh --version 2>&1 | grep -o '[0-9][0-9.]*')" && $(CASES_READ) && exit 0; \
	sh edp/case/read.sh 0 ready; exit 1

$(VENV)/run.stamp: requirements.txt | system
	@{ $(FIND_PYTHON); } || { echo 'Please install Python 3.11 or newer, with its venv module'; exit 1; }; \
	case $$found in \
	  own) $$python -m venv --system-site-packages --without-pip $(VENV);; \
	  *) $$python -m venv $(VENV) && { $(PIP_INSTALL); };; \
	esac
	@touch $@

$(VENV)/dev.stamp: requirements-dev.txt $(VENV)/run.stamp | system reader
	@$(PYTHON) -c 'import ensurepip' 2>/dev/null || missing=' python3-venv'; $(INSTALL_MISSING)
	@$(PYTHON) -m pip --version >/dev/null 2>&1 || $(PYTHON) -m ensurepip >/dev/null
	@$(PIP_INSTALL)
	@touch $@

# Runs need no Python, the pictures of them do: what cannot be had now is no reason not to run.
python: | system
	@test -e $(VENV)/run.stamp || PIP_RETRIES=1 $(MAKE) -s --no-print-directory $(VENV)/run.stamp || \
	  echo 'no Python for the pictures: make setup says more'

# The plugin that assembles and sorts: put in place once it has been loaded, the .idp that names it last. FreeFEM's program is a
# prerequisite: a plugin is of one version.
fast: | system ## build the plugin that assembles and sorts matrices faster, where there is a compiler
	@$(MAKE) -s --no-print-directory $(FAST)

try-fast: | system
	@if command -v ff-c++ >/dev/null && command -v $${CXX:-g++} >/dev/null; then \
	  $(MAKE) -s --no-print-directory $(FAST) >/dev/null 2>&1 || \
	  echo 'the plugin of make fast could not be built ($(BUILD)/fast.log): runs go on without it'; fi

$(FAST): edp/operator/fast.cpp $(wildcard /usr/bin/FreeFem++)
	@rm -rf $(BUILD)/fast-new $@; mkdir -p $(BUILD)/fast-new && cp $< $(BUILD)/fast-new && cd $(BUILD)/fast-new && \
	echo 'load "./fast"' >try.edp && { ff-c++ fast.cpp && FreeFem++ -nw -v 0 try.edp; } >../fast.log 2>&1 && mv fast.so $(abspath $(FAST:.idp=.so)) || { \
	  cd .. && rm -rf fast-new && echo 'the plugin of make fast could not be built: $(BUILD)/fast.log'; exit 1; \
	}
	@rm -rf $(BUILD)/fast-new
	@printf '%s\n' '// written by make fast' 'load "$(basename $(@F))"' 'macro byPlugin(statement) statement //' >$@
	@$(NAME_BUILD)

# The plugin for -solver multigrid, on Debian's PETSc or on the one in $(PETSC), which has include/ and lib/ (named on the command
# line, or the variables PETSC_DIR/PETSC_ARCH of a PETSc of one's own).
PETSC = $(firstword $(if $(PETSC_DIR),$(PETSC_DIR)/$(PETSC_ARCH)) $(wildcard /usr/lib/petscdir/petsc*/*-linux-gnu-real))

NAME_BUILD = test -z "$(CACHE)" || { cat ~/.freefem++.pref 2>/dev/null; \
	  printf '%s += "$(BUILD)"\n' loadpath includepath; } >$(BUILD)/.freefem++.pref

mpi: | petsc ## build the plugin for -solver multigrid and several processes: make mpi [PETSC=/its/folder]
	@$(MAKE) -s --no-print-directory $(MULTIGRID)

petsc: | system
	@missing=; \
	test -n "$(PETSC)" || missing=' libpetsc-real-dev'; \
	command -v mpicxx >/dev/null || missing="$$missing libopenmpi-dev"; \
	command -v g++ >/dev/null || missing="$$missing g++"; \
	$(INSTALL_MISSING)

# ff-c++ writes beside its source; what is built is put in place when it is whole, the .idp that names it last.
$(MULTIGRID): edp/operator/multigrid.cpp $(wildcard edp/operator/multigrid-*.hpp) Makefile
	@mkdir -p $(BUILD)/new && cp $(filter-out Makefile,$^) $(BUILD)/new && cd $(BUILD)/new && \
	ff-c++ -mpi -I$(PETSC)/include $$(mpicxx --showme:compile) -L$(PETSC)/lib -Wl,-rpath,$(PETSC)/lib \
	  $$(if ls $(PETSC)/lib/libpetsc_real.* >/dev/null 2>&1; then echo -lpetsc_real; else echo -lpetsc; fi) \
	  $$(mpicxx --showme:link) multigrid.cpp >../multigrid.log 2>&1 && mv multigrid.so $(abspath $(MULTIGRID:.idp=.so)) || { \
	  cd .. && grep -m 3 'error:' multigrid.log || tail -n 5 multigrid.log; \
	  echo "the plugin could not be built with the PETSc in $(PETSC): $(BUILD)/multigrid.log"; exit 1; \
	}
	@rm -rf $(BUILD)/new
	@printf '%s\n' '// written by make mpi' 'load "$(basename $(@F))"' 'macro multigridBuilt() 1 //' >$@
	@$(NAME_BUILD)
	@echo 'built: -solver multigrid, in scenes in space'

# ---------------------------------------------------------------- runs

# NP=2: on two processes. Open MPI, in versions 4 and 5, wants to be told that it may run as root and with more processes than cores.
MPI := OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
  OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe
RUN_ONE  = $(if $(findstring -plot 1,$(ARGS)),$(FREEFEM:-nw=),$(FREEFEM)) $(SCRIPT) $(ARGS)
RUN_MANY = $(MPI) mpiexec -n $(NP) $(subst FreeFem++,FreeFem++-mpi,$(FREEFEM)) $(SCRIPT) -solver multigrid $(ARGS)
run: | system python $(if $(NP),mpi) ## run a scene: make run [SCENE=name] [ARGS="-kappa 1e6"] [NP=processes, in space]
	@$(if $(NP),$(RUN_MANY),$(RUN_ONE)); code=$$?; \
	case $$code in 0) exit 0;; 10) why='refused input';; 20) why='not converged';; 21) why='accuracy not reached';; 30) why='out of memory or disk';; *) why='failed';; esac; \
	echo "FreeFem++ ended with code $$code: $$why"; exit $$code

# What is begun sees the package through links: FreeFEM finds its modules, results stay outside.
new: ## begin a law, a scene or a method of your own outside this folder: make new DIR=folder
	@test -n '$(DIR)' || { echo 'DIR=: allowed: a folder that is not there yet'; exit 10; }; \
	test ! -e '$(DIR)' || { echo 'DIR=$(DIR): is there already'; exit 10; }; \
	mkdir -p '$(DIR)' && cp template/* '$(DIR)' && \
	for name in edp meshes postprocess build freefem++.pref .venv; do ln -s '$(CURDIR)'/$$name '$(DIR)' || exit 1; done && \
	echo 'begun: $(DIR); read its README.md, then: sh $(DIR)/test.sh'

# ---------------------------------------------------------------- a place of its own

PREFIX ?= /usr/local
NAME   := stiff-contact
export PREFIX DESTDIR

install: ## put scripts, Python commands and the starter stiff-contact below PREFIX: make install [PREFIX=/usr/local] [DESTDIR=]
	@$(if $(findstring $$,$(value PREFIX)$(value DESTDIR)),echo 'PREFIX or DESTDIR: a dollar sign; make would replace it; allowed: a whole path without'; exit 10,:)
	@case $$PREFIX in *[\;\'\"]* | [!/]* | '') echo "PREFIX=$$PREFIX: allowed: a whole path without ; and quotes"; exit 10;; esac; \
	share=$$DESTDIR$$PREFIX/share/$(NAME) bin=$$DESTDIR$$PREFIX/bin; set -e; \
	rm -rf "$$share"; mkdir -p "$$share" "$$bin"; \
	tar -cf - --exclude=__pycache__ --exclude=generated --exclude='*.msh' --exclude='.making-*' \
	  edp meshes postprocess README.md CHANGELOG.md CITATION.cff LICENSE requirements.txt freefem++.pref | (cd "$$share" && tar -xof -); \
	for plugin in $(MULTIGRID:.idp=) $(FAST:.idp=); do \
	  test ! -e $$plugin.idp || { mkdir -p "$$share/build"; cp $$plugin.so $$plugin.idp "$$share/build"; }; \
	done; \
	printf '%s\n' '#!/bin/sh' '# $(NAME): scenes and Python commands of the package from any folder: $(NAME) wavy -h 0.1' \
	  "CONTACT_STARTER=\$$0 exec sh '$$PREFIX/share/$(NAME)/edp/freefem.sh' \"\$$@\"" >"$$bin/$(NAME)"; \
	: >"$$share/.installed"; chmod -R a+rX "$$share"; chmod 755 "$$bin/$(NAME)"; \
	echo "installed: $$PREFIX/bin/$(NAME)"

uninstall: ## remove what make install has put below PREFIX
	rm -rf "$$DESTDIR$$PREFIX/share/$(NAME)" "$$DESTDIR$$PREFIX/bin/$(NAME)"

# ---------------------------------------------------------------- figures

# case.<name>: script and flags; the run writes results/figures/<name>/, summary.json last.
# The paper's test, both bodies meshed: figures 1 and 2, convergence and thresholds are of one mesh.
TEST                  := edp/scenes/meshed-disc.edp -order 1 -h 0.5
case.paper            := $(TEST) -method paper -states 1
case.incremental      := $(TEST) -method incremental -steps 20
case.signorini-start  := $(TEST) -method paper -T0 d0
case.newton           := $(TEST) -method newton
case.xnewton          := $(TEST) -method xnewton
case.hertz-line       := edp/scenes/hertz-line.edp -width 160 -depth 80 -grading 160 -order 2 -axis 1
case.two-cylinders    := edp/scenes/two-cylinders.edp -R1 40 -R2 40 -force 2.158 -grading 80 -order 2 -axis 1
case.hertz-sphere     := edp/scenes/hertz-line.edp -geometry axisymmetric -force 10 -h 0.044 -order 2 -axis 1
case.sphere           := edp/scenes/sphere-on-block.edp -law signorini -force 14.652014652 -patch 1.6 -layers 2 -h 0.2 -grading 40 -d0 0 -gap 0
case.sphere-on-plane  := edp/scenes/sphere-on-plane.edp -h 0.14 -layers 3
case.two-spheres      := edp/scenes/two-spheres.edp -h 0.14 -layers 3
case.rough-series     := edp/scenes/rough.edp -kappa 1e9 -history 1 -steps 20
STICKY                := edp/scenes/adhesive-sphere.edp -w 0.003108162 -h 0.00707 -fine 0.38 -grading 283
case.attraction-path  := $(STICKY) -path "-0.0041 0.0017 -0.0041" -steps 10
case.attraction-curve := $(STICKY) -path "-0.0041 0.0017" -branch unstable
case.patch-nodal      := edp/scenes/patch-test.edp -tol 1e-11 -points nodal
case.patch-segment    := edp/scenes/patch-test.edp -tol 1e-11
case.patch-3d-nodal   := edp/scenes/patch-test-3d.edp -tol 1e-11 -points nodal
case.patch-3d-segment := edp/scenes/patch-test-3d.edp -tol 1e-11
PUNCH                 := edp/scenes/flat-punch.edp -a 1 -force 20 -order 2 -h 0.0125 -grading 160
case.punch-hard       := $(PUNCH) -law signorini
case.punch-1e6        := $(PUNCH) -kappa 1e6
case.punch-1e3        := $(PUNCH) -kappa 1e3
WAVY                  := edp/scenes/wavy.edp -law signorini -nu 0 -width 20 -depth 5 -waves 10 -amplitude 0.02 -order 2 -h 0.05
case.wavy-0.1         := $(WAVY) -force 6.283185307
case.wavy-0.5         := $(WAVY) -force 31.41592654
case.wavy-1.5         := $(WAVY) -force 94.24777961
case.disc-rigid       := edp/main.edp -order 2 -h 0.5 -tol 1e-11
$(foreach ratio,1 1e2 1e4 1e6,$(eval case.disc-$(ratio) := edp/scenes/meshed-disc.edp -order 2 -h 0.5 -tol 1e-11 -Eratio $(ratio)))

# Hertz with a = 1 in bodies that are large beside it; h = 1/5 ... 1/20: a node stands at the edge of a line or axisymmetric
# contact, for where the edge lies between the nodes changes the error as much as h does. In space, h and the grid's layers.
ERROR.hertz-line      := edp/scenes/hertz-line.edp -R 100 -force 0.8630749048 -width 640 -depth 320 -grading 640
ERROR.two-cylinders   := edp/scenes/two-cylinders.edp -R1 400 -R2 400 -force 0.2157687262 -grading 800
ERROR.axisymmetric    := edp/main.edp -geometry axisymmetric -law signorini -R 100 -force 1.4652014652 -reach 2 -grading 80
ERROR.sphere-on-block := edp/scenes/sphere-on-block.edp -law signorini -R 100 -force 1.4652014652 -patch 1.3 -grading 80
ERROR.sphere-on-plane := edp/scenes/sphere-on-plane.edp -R 40 -force 3.663003663 -grading 80
ERROR.two-spheres     := edp/scenes/two-spheres.edp -R1 40 -R2 40 -force 3.663003663 -grading 80
error_case = $(eval case.error-$(1)-$(2) := $(ERROR.$(1)) -vtu 0 $(3))error-$(1)-$(2)
part       = $(word $(2),$(subst -, ,$(1)))
ERRORS := \
  $(foreach scene,hertz-line two-cylinders axisymmetric,$(foreach order,1 2,$(foreach h,0.2 0.1428572 0.1 0.0714286 0.05,\
    $(call error_case,$(scene),p$(order)-$(h),-order $(order) -h $(h))))) \
  $(foreach scene,sphere-on-block sphere-on-plane two-spheres,$(foreach size,0.4-1 0.28-2 0.2-2 0.14-3,\
    $(call error_case,$(scene),$(size),-h $(call part,$(size),1) -layers $(call part,$(size),2))))

# figure.<name>: the cases that it draws.
figure.figure1     := paper
figure.figure2     := paper incremental
figure.convergence := paper signorini-start newton xnewton
figure.thresholds  := paper signorini-start
figure.hertz-line    := hertz-line
figure.two-cylinders := two-cylinders
figure.hertz-sphere  := hertz-sphere
figure.rough-series  := rough-series
figure.sphere        := sphere
figure.attraction    := attraction-path attraction-curve
figure.attraction-profiles := attraction-path
figure.sphere-on-plane := sphere-on-plane
figure.two-spheres   := two-spheres
figure.hertz-error   := $(ERRORS)
figure.patch-test    := patch-nodal patch-segment patch-3d-nodal patch-3d-segment
figure.flat-punch    := punch-hard punch-1e6 punch-1e3
figure.wavy          := wavy-0.1 wavy-0.5 wavy-1.5
figure.meshed-disc   := disc-rigid disc-1 disc-1e2 disc-1e4 disc-1e6
# draw.<figure>: its kind, where that is not its name
draw.hertz-line    := hertz
draw.two-cylinders := hertz
draw.hertz-sphere  := hertz
draw.rough-series  := series
draw.attraction-profiles := attraction_profiles
draw.sphere-on-plane := sphere
draw.two-spheres   := sphere
draw.hertz-error   := hertz_error
draw.patch-test    := patch
draw.flat-punch    := punch
draw.wavy          := waves
draw.meshed-disc   := rigid

CASES   := $(sort $(patsubst case.%,%,$(filter case.%,$(.VARIABLES))))
FIGURES := $(sort $(patsubst figure.%,%,$(filter figure.%,$(.VARIABLES))))

figures: $(FIGURES:%=$(RESULTS)/figures/%.pdf) $(FIGURES:%=$(RESULTS)/figures/%.png) ## draw every figure into results/figures/, with the runs that it needs

# The Makefile is a prerequisite because it holds the flags.
$(CASES:%=$(RESULTS)/figures/%/summary.json): $(RESULTS)/figures/%/summary.json: $$(firstword $$(case.$$*)) $(SOURCES) Makefile | system
	$(FREEFEM) $(case.$*) -out $(@D)

# A pattern with two targets makes both in one go.
$(RESULTS)/figures/%.pdf $(RESULTS)/figures/%.png: $$(addsuffix /summary.json,$$(addprefix $(RESULTS)/figures/,$$(figure.$$*))) $(wildcard postprocess/*.py postprocess/*/*.py) | $(VENV)/run.stamp
	$(PYTHON) -m postprocess figure $(or $(draw.$*),$*) --out $(RESULTS)/figures/$*.pdf $(figure.$*:%=$(RESULTS)/figures/%)

# The pictures of the pages. Those of the campaigns are of the tables in tests/RESULTS.md and COST.md; the labs' need make labs, the cut PyVista.
SMALL := $(PYTHON) -m postprocess small
pictures: $(RESULTS)/figures/figure1.png $(RESULTS)/figures/sphere/summary.json | $(VENV)/run.stamp ## draw the small pictures of the pages anew
	$(SMALL) $(RESULTS)/figures/figure1.png --width 600 --out postprocess/readme-figure.png
	$(MAKE) movie ARGS='-method paper -order 1 -h 0.5'
	$(SMALL) $(RESULTS)/movies/disc-on-block/movie.gif --width 540 --out postprocess/readme-movie.gif
	for page in edp/examples/*/README.md; do \
	  picture=$$(sed -n 's/^!\[.*](\(.*\.png\))/\1/p' $$page); \
	  sed -n '/^```sh/,/^```/{/^[^`]/p;}' $$page | while read -r command; do sh -c "$$command" </dev/null || exit 1; done && \
	  $(SMALL) $(RESULTS)/parts*/$$(basename $$(dirname $$page))/$$picture --width 560 --out $$(dirname $$page)/$$picture || exit 1; \
	done
	for page in edp/tutorial/*.md; do sed -n '/^```sh/,/^```$$/{/^[^`]/p;}' $$page | sh; done; \
	$(SMALL) $(RESULTS)/disc-on-block/xnewton/state.png --width 720 --out edp/tutorial/disc-on-block.png && \
	$(SMALL) $(RESULTS)/parts/foot/state.png --width 720 --out edp/tutorial/foot.png && \
	$(SMALL) $(RESULTS)/fretting/xnewton/hysteresis.png --width 720 --out edp/tutorial/hysteresis.png && \
	$(SMALL) $(RESULTS)/parts-3d/wheel-on-rail/check/faces.png --width 640 --out edp/tutorial/faces.png
	PYTHONPATH=.:tests $(PYTHON) tests/campaigns/pictures.py --out postprocess/readme-peers.png
	PYTHONPATH=.:tests $(PYTHON) tests/campaigns/pictures.py --out postprocess/readme-stability.png
	for lab in edp/labs/*/; do \
	  name=$$(sed -n 's/^\*`\([a-z]*\.png\)` of these commands.*/\1/p' $$lab/README.md); \
	  $(SMALL) $$(find $(RESULTS)/labs/$$(basename $$lab) -name $$name) --width $$(case $$name in stress*) echo 560;; *) echo 700;; esac) --out $$lab/figure.png || exit 1; \
	done
	for sketch in 0-algorithm/models 3-threshold/cut 3-threshold/four_five 3-threshold/bridge; do \
	  $(SMALL) $(RESULTS)/labs/$$sketch.png --width 700 --out edp/labs/$$sketch.png || exit 1; \
	done
	$(PYTHON) -m postprocess cut $(RESULTS)/figures/sphere --units mm MPa --out postprocess/readme-sphere.png

# ---------------------------------------------------------------- campaigns

# Many runs, a row each; interrupted and started again, they go on where they were.
CAMPAIGN_FIGURES = $(basename $(notdir $(filter-out %_peers.py,$(wildcard postprocess/figures/$@_*.py))))

define DRAW_CAMPAIGN
for figure in $(CAMPAIGN_FIGURES); do \
	  $(PYTHON) -m postprocess figure $$figure --out $(RESULTS)/$@/$$figure.pdf $(RESULTS)/$@ || exit 1; \
	done
endef

bench: $(VENV)/run.stamp | system ## error against run time, cost growth, ingredients, timed one run at a time, into results/bench/
	@$(PYTHON) tests/campaigns/bench.py
	@$(DRAW_CAMPAIGN)

# Large bodies: up to three million unknowns in space, 8 GB, an hour.
bench-large: $(VENV)/run.stamp | system mpi ## sizes in space up to three million unknowns with -solver multigrid, laws, into results/bench/
	@$(MPI) $(PYTHON) tests/campaigns/bench.py large

bench-ranks: $(VENV)/run.stamp | system mpi ## memory and answers of one, two and four processes, with lean levels too, into results/bench/
	@$(MPI) $(PYTHON) tests/campaigns/bench.py ranks

# NGSolve is wanted by this target alone.
$(VENV)-peers/run.stamp: requirements-peers.txt | system
	@{ $(FIND_PYTHON); } || { echo 'Please install Python 3.11 or newer, with its venv module'; exit 1; }; \
	echo "Installing $< into $(VENV)-peers"; \
	$$python -m venv $(VENV)-peers && \
	$(VENV)-peers/bin/python -m pip install -q --no-input --disable-pip-version-check --retries 1 -r $< 2>$(VENV)-peers/pip.log || { \
	  echo "bench-peers: pip could not install $< (is a package index reachable?); its messages: $(VENV)-peers/pip.log"; exit 1; \
	}
	@touch $@

bench-peers: $(VENV)/run.stamp $(VENV)-peers/run.stamp | system reader ## the same tests solved by NGSolve, timed in turns with the package, and parts by CalculiX (ccx), into results/bench/
	@$(PYTHON) tests/campaigns/peers.py
	@$(PYTHON) tests/campaigns/peers_condensed.py
	@$(PYTHON) -m postprocess figure bench_peers --out $(RESULTS)/bench/bench_peers.pdf $(RESULTS)/bench
	@if command -v ccx >/dev/null; then $(PYTHON) tests/campaigns/calculix.py --space && $(PYTHON) tests/campaigns/calculix_parts.py; \
	else echo 'parts beside CalculiX: no ccx here (Debian: calculix-ccx)'; fi

# Code 1: a run failed or a check did not pass; the figures show it.
stability: $(VENV)/run.stamp | system ## counts and failures over laws, stiffness, meshes, loads and friction, into results/stability/, results/friction/
	@$(PYTHON) tests/campaigns/stability.py; code=$$?; \
	case $$code in 0|1) $(DRAW_CAMPAIGN); $(PYTHON) tests/campaigns/friction.py || code=$$?;; esac; exit $$code

friction: $(VENV)/run.stamp | system ## the part of make stability with friction: paths of loads that a seed draws, into results/friction/
	@$(PYTHON) tests/campaigns/friction.py

coverage: $(VENV)/run.stamp | system reader ## whether the estimates of the error hold, over scenes and over parts that a seed draws, into results/coverage/
	@$(PYTHON) tests/campaigns/covered.py
	@$(PYTHON) tests/campaigns/foreign.py

conditioning: $(VENV)/run.stamp | system ## condition of plain Newton's tangent and its steps, into results/conditioning/
	@PYTHONPATH=.:tests $(PYTHON) tests/campaigns/conditioning.py && $(DRAW_CAMPAIGN)

models: $(VENV)/run.stamp | system ## walls, tangents, plain Newton and xnewton on 75 problems and two meshes, into results/models/
	@PYTHONPATH=.:tests $(PYTHON) tests/campaigns/models.py && $(DRAW_CAMPAIGN)

plasticity: $(VENV)/run.stamp | system reader ## 48 problems of plastic bodies, hardness, first yield, CalculiX if it is there, into results/plasticity/
	@PYTHONPATH=.:tests $(PYTHON) tests/campaigns/plasticity.py
	@if command -v ccx >/dev/null; then PYTHONPATH=.:tests $(PYTHON) tests/campaigns/plasticity.py --calculix; \
	else echo 'the comparison with CalculiX: no ccx here (Debian: calculix-ccx)'; fi

mutants: $(VENV)/dev.stamp | system ## small errors planted in the scripts, and which of them no test sees: make mutants [COUNT=200], into results/mutants/
	@$(PYTHON) tests/campaigns/mutants.py $(COUNT)

verification: $(VENV)/dev.stamp | system ## solve published benchmarks, and write their numbers into tests/VERIFICATION.md
	@PYTHONPATH=.:tests:tests/campaigns $(PYTHON) tests/campaigns/verification.py

tables: $(VENV)/run.stamp ## write the campaigns' results into the tables of tests/RESULTS.md and tests/COST.md
	@PYTHONPATH=tests $(PYTHON) tests/campaigns/tables.py $(if $(PARTIAL),--partial)

# ---------------------------------------------------------------- labs

# Line by line as the labs' READMEs have them. Code 20: one of them stops a run early, as it says.
labs: $(VENV)/run.stamp | system reader ## run every command of the labs (edp/labs), with their figures, into results/labs/
	@for readme in edp/labs/*/README.md; do \
	  sed -n '/^```sh/,/^```/p' $$readme | grep -v '^[`#]' | while read -r command; do \
	    echo "$$command"; sh -c "$$(echo "$$command" | sed 's, results/, $(RESULTS)/,g;s,^.venv/,$(VENV)/,')" </dev/null; code=$$?; \
	    case $$code in 0|20) ;; *) exit $$code;; esac; \
	  done || exit $$?; \
	done

# The run of lab 3 is the film of the slides.
kit: $(VENV)/run.stamp | system reader ## the teaching kit: slides, notes, handouts, expected values, lab 0 without gmsh, into results/kit/
	@$(FREEFEM) edp/labs/3-threshold/threshold.edp -h 0.25 -vtu 0 -estimate 0 -out $(RESULTS)/labs/kit-film >/dev/null
	@$(PYTHON) -m postprocess kit $(RESULTS)/labs/kit-film --out $(RESULTS)/kit

notebooks: $(VENV)/run.stamp ## a notebook for Jupyter of each lab, from the labs' own pages, into results/notebooks/
	@$(PYTHON) -m postprocess notebooks --out $(RESULTS)/notebooks

page: $(VENV)/run.stamp | system ## one HTML page that needs nothing installed: Algorithm 1 step by step, into results/page/
	@$(PYTHON) -m postprocess play --out $(RESULTS)/page/algorithm1.html

site: $(VENV)/dev.stamp ## all pages as a site to search, without the labs' answers: make site [TEACHER=1], into results/site/
	@PYTHONPATH=. $(PYTHON) tests/documents.py $(if $(TEACHER),--answers) --out $(RESULTS)/site

# make check-lab 2 ANSWERS=file: the lab's number is no target of its own.
N       ?= $(filter 0 1 2 3 4 5 6 7 8 9 10 11,$(MAKECMDGOALS))
ANSWERS ?= answers.csv
check-lab: $(VENV)/run.stamp ## check a student's answers: make check-lab 2 ANSWERS=answers.csv, make check-lab 4 ANSWERS=mylaw.idp
	@$(PYTHON) -m postprocess check_lab $(or $(N),none) '$(ANSWERS)'

ifneq ($(filter check-lab,$(MAKECMDGOALS)),)
.PHONY: 0 1 2 3 4 5 6 7 8 9 10 11
0 1 2 3 4 5 6 7 8 9 10 11:
	@:
endif

# ---------------------------------------------------------------- looking

MOVIE := $(RESULTS)/movies/$(SCENE)

# Code 20, not converged: the steps are there, and worth seeing.
movie: $(VENV)/run.stamp | system ## show the method at work: make movie [SCENE=name] [ARGS="-method paper -h 0.5"], into results/movies/
	@$(FREEFEM) $(SCRIPT) $(ARGS) -states 1 -out $(MOVIE); code=$$?; \
	case $$code in 0|20) ;; *) echo "FreeFem++ ended with code $$code: no movie"; exit $$code;; esac; \
	$(PYTHON) -m postprocess movie --out $(MOVIE) $(MOVIE) && exit $$code

report: $(VENV)/run.stamp | system ## one page of everything that has been run, with errors against run times: results/report/index.html
	@for method in xnewton newton paper; do for order in 1 2; do for h in 1 0.5 0.25; do \
	  run=$(RESULTS)/accuracy/$$method-P$$order-$$h; \
	  test -e $$run/summary.json || $(FREEFEM) edp/main.edp -method $$method -order $$order -h $$h -vtu 0 -estimate 0 -out $$run >/dev/null || exit 1; \
	done; done; done
	@$(PYTHON) -m postprocess report --out $(RESULTS)/report/index.html $(RESULTS)

doctor: ## say what is installed, what is missing and how to get it
	@{ $(FIND_PYTHON); } || python=python3; $$python postprocess/doctor.py

# ---------------------------------------------------------------- checks

# Where PETSc is, the plugin is built, and tested; where not, its tests are skipped. Which tests are not quick: tests/long.txt, and
# tests/nightly.txt for the dearest, which only test-all runs.
test: ## run the quick tests: make test [TESTS=tests/test_x.py] [PYTEST_ARGS=-v]
test-long: ## run the other tests of .ci/run
test-all: ## run every test there is
test:      WHICH := not long
test-long: WHICH := long and not nightly
test-all:  WHICH := long or not long
test test-long test-all: $(VENV)/dev.stamp | system
	@test -z "$(PETSC)" || ! command -v mpicxx >/dev/null || $(MAKE) -s --no-print-directory $(MULTIGRID)
	@PYTHONDONTWRITEBYTECODE= $(PYTHON) tests/run.py '$(WHICH)' $(PYTEST_ARGS) $(TESTS)

# What tests need beside the package: each is skipped where its tool is not there.
tools: mpi $(VENV)-peers/run.stamp | system ## install what some tests are skipped without: the plugin of make mpi, NGSolve, CalculiX, Chromium, a locale's sources
	@missing=; \
	command -v chromium chromium-browser google-chrome >/dev/null || missing=' chromium'; \
	command -v ccx >/dev/null || missing="$$missing calculix-ccx"; \
	test -e /usr/share/i18n/locales/de_DE || missing="$$missing locales"; \
	$(INSTALL_MISSING)

# As root, with debootstrap. CONTACT_SYSTEMS=folder keeps the trees; SYSTEMS="trixie noble" chooses.
test-systems: | system ## in bare Debian 12, Debian 13, Ubuntu 24.04: the README's commands, make test, the same numbers
	@{ $(FIND_PYTHON); } && PYTEST_ARGS='$(PYTEST_ARGS)' TESTS='$(TESTS)' $$python tests/systems.py $(SYSTEMS)

choice: $(VENV)/dev.stamp | system ## find for an hour what each test costs and reaches, and choose the quick tests anew (tests/long.txt)
	@$(PYTHON) tests/campaigns/choose.py measure && $(PYTHON) tests/campaigns/choose.py

lint: $(VENV)/dev.stamp ## check the style of the Python and FreeFEM sources
	@$(PYTHON) -m ruff check postprocess tests edp/case
	@$(PYTHON) -m ruff format --check postprocess tests edp/case
	@MYPYPATH=edp/case $(PYTHON) -m mypy --strict -p reader
	@$(PYTHON) tests/lint_edp.py edp

pages: $(VENV)/run.stamp | system ## write the pages' tables from heads, -help, a few short runs and a case file's grammar
	@$(PYTHON) tests/pages.py

uses: $(VENV)/run.stamp | system ## print which names MODULE (problem/problem.idp, say) uses of which others, and who uses it
	@$(PYTHON) tests/pages.py $(or $(MODULE),problem/problem.idp)

numbers: pages $(VENV)/dev.stamp | system ## run the commands of the pages' numbers anew, write those that have changed, and show them
	@PYTHONPATH=.:tests:tests/campaigns $(PYTHON) tests/page_numbers.py
	@PYTHONPATH=.:tests $(PYTHON) tests/screens.py

clean: ## remove results and generated meshes
	rm -rf results meshes/generated $(patsubst %/.shared,%,$(wildcard $(CACHE:%=%/meshes/.shared)))

distclean: clean ## remove the virtual environment and caches as well
	rm -rf $(dir $(wildcard $(VENV)/run.stamp $(VENV)-peers/run.stamp $(BUILD)/multigrid.log $(BUILD)/fast.log)) .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
