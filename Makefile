# camroller: `make help` lists what can be made. Everything can be repeated; what is done is not done again.

SHELL := /bin/bash
.DEFAULT_GOAL := help
.PHONY: help setup commit build debug counted mpi example install run dynamics comparison test quick bless random random-ehl random-flexible random-hosts random-wide step-estimates needed needed-flexible rough-rows fuzz sanitize faults study study-film study-dynamics film-heat audit trends check check-layers \
  check-style check-format check-lint check-warnings second-compiler format docs recipes bench bench-dynamics bench-ehl range-ehl bench-batch bench-cases bench-effects bench-hosts clean distclean

FPM := tools/fpm
PYTHON := .venv/bin/python
# that of .venv where it is there, which the tests take as well
CMAKE = $(or $(wildcard .venv/bin/cmake),cmake)

# Both builds keep to the standard and never let the compiler change values: no -ffast-math, and no fused
# multiply-add, so that results do not depend on whether a machine has it. The plain x86-64 target of gfortran has none
# anyway. fpm keeps a folder for each set of flags. build/commit holds the commit, see tools/write_commit.sh.
export PKG_CONFIG_PATH := $(CURDIR)/build/pkgconfig:$(PKG_CONFIG_PATH)
# -g1 has the lines of backtraces and of valgrind, and compiles in five sixths of the time that -g takes.
COMMON_FLAGS := -std=f2018 -g1 -ffp-contract=off -fbacktrace -Ibuild/commit
# -Og makes the checked tests take 0.6 of the time. What gfortran 12 then guesses of values that may not be set is wrong with allocatable
# components; reals that are truly not set are found by -finit-real=snan, in components of derived types with -finit-derived.
export DEBUG_FLAGS := $(COMMON_FLAGS) -g -Og -Wall -Wextra -Wimplicit-interface -Wno-maybe-uninitialized -Wno-uninitialized \
  -fcheck=all -ffpe-trap=invalid,zero,overflow -finit-real=snan -finit-derived
export OPTIMISED_FLAGS := $(COMMON_FLAGS) -O3
# The program: with -flto small procedures of other modules are inlined, a tenth fewer instructions a case and not one bit of a result
# another (doc/notes/batch.md). Linking so takes minutes: `make test` links its tests with the machine code that the objects hold as well,
# and other targets compile without. gcc-ar writes the index of such objects.
export RELEASE_FLAGS := $(OPTIMISED_FLAGS) -flto=auto -ffat-lto-objects
export FPM_AR := gcc-ar
export SANITIZE_FLAGS := $(COMMON_FLAGS) -O1 -fno-omit-frame-pointer -fsanitize=address,undefined

help: ## list what can be made
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1|\2/p' $(MAKEFILE_LIST) | column -t -s '|' 2> /dev/null || \
	  sed -n 's/^\([a-z-]*\):.*## \(.*\)/make \1: \2/p' $(MAKEFILE_LIST)

setup: ## system packages, Python tools in .venv, test-drive
	@tools/setup.sh

commit: setup
	@tools/write_commit.sh

# with what the program does not use as well, for examples and the program for many nodes
build: commit ## the program: build/release/bin/camroller; the library beside it
	@$(FPM) install --no-prune --flag "$(RELEASE_FLAGS)" --prefix build/release > build/release.log 2>&1 || \
	  { cat build/release.log; exit 1; }

debug: commit ## the program with all run-time checks: build/debug/bin/camroller
	@$(FPM) install --flag "$(DEBUG_FLAGS)" --prefix build/debug > build/debug.log 2>&1 || { cat build/debug.log; exit 1; }

counted: commit ## the program without -flto, whose procedures valgrind can tell apart: build/counted/bin/camroller
	@$(FPM) install --flag "$(OPTIMISED_FLAGS)" --prefix build/counted > build/counted.log 2>&1 || { cat build/counted.log; exit 1; }

mpi: build ## the program for many nodes, where Open MPI is there: build/mpi/bin/camroller-mpi
	@tools/build_mpi.sh

# -fno-lto: of the machine code in the library, which takes a second; without it the whole library would be optimised again
example: build ## run example/library/two_cases.f90, which uses camroller as a library: EXAMPLE=many_cases for the other one
	@mkdir -p build/example
	@gfortran $(OPTIMISED_FLAGS) -fno-lto -Jbuild/example -Ibuild/release/include -o build/example/$(or $(EXAMPLE),two_cases) \
	  example/library/$(or $(EXAMPLE),two_cases).f90 -Lbuild/release/lib -lcamroller $$(pkg-config --libs hdf5) \
	  -lhdf5_fortran -lhdf5_hl -lhdf5hl_fortran -lopenblas -fopenmp
	@build/example/$(or $(EXAMPLE),two_cases)

run: build ## run decks/thesis.nml and plot it: results/thesis.h5 and figures beside it
	@mkdir -p results
	build/release/bin/camroller run decks/thesis.nml -o results/thesis.h5
	$(PYTHON) post/plot.py results/thesis.h5 --output results

comparison: build ## compare with the source thesis: doc/thesis_comparison.md and doc/figures
	@mkdir -p results/comparison doc/figures
	@set -o pipefail; $(PYTHON) post/thesis/thesis_comparison.py --runs | while read -r name arguments; do \
	  build/release/bin/camroller run $$arguments -o results/comparison/$$name.h5 --quiet || exit 1; done
	$(PYTHON) post/thesis/thesis_comparison.py results/comparison --page doc/thesis_comparison.md
	@for figure in mean_torque slip; do $(PYTHON) post/plot.py results/comparison/thesis.h5 \
	  results/comparison/thesis_source.h5 --figure $$figure --dpi 90 --output doc/figures || exit 1; done
	@$(PYTHON) post/plot.py results/comparison/thesis.h5 --figure mean_torque --dpi 90 --output doc/figures
	@$(PYTHON) post/plot.py results/comparison/thesis.h5 --figure overview --dpi 72 --output doc/figures

study: build ## what accuracy costs on decks/thesis.nml: table and figure of doc/accuracy_and_cost.md, three minutes
	@mkdir -p results
	build/release/bin/camroller study decks/thesis.nml -o results/thesis_study.h5 > results/thesis_study.txt
	cp results/thesis_study.txt doc/accuracy_tables.txt
	$(PYTHON) post/plot_study.py results/thesis_study.h5 --output doc/figures --name thesis

study-film: build ## what the accuracy of a numerical film costs, at 300 rev/min: table and figure of doc/ehl.md, one minute
	@mkdir -p results
	OPENBLAS_NUM_THREADS=1 build/release/bin/camroller study decks/numerical_film.nml --film --set sweep.values_1=300 \
	  -o results/film_study.h5 > results/film_study.txt
	cp results/film_study.txt doc/film_tables.txt
	$(PYTHON) post/plot_study.py results/film_study.h5 --output doc/figures --name film

film-heat: build ## what heat does to contacts that are solved: table and figure of doc/ehl.md, two minutes
	@mkdir -p results/film_heat
	@(cat decks/heated_contact.nml; echo "&ehl profiles = .true. /") > results/film_heat/deck.nml
	OPENBLAS_NUM_THREADS=1 build/release/bin/camroller run results/film_heat/deck.nml -o results/film_heat/heated.h5 --quiet
	OPENBLAS_NUM_THREADS=1 build/release/bin/camroller run results/film_heat/deck.nml --set heat.inlet_law=none --set heat.contact=none \
	  -o results/film_heat/isothermal.h5 --quiet
	(printf '# Heat in contacts that are solved\n\n`make film-heat` makes this table. What it means: [ehl.md](ehl.md#temperature-along-the-contact).\n\n'; \
	  $(PYTHON) post/film_heat.py results/film_heat/heated.h5 results/film_heat/isothermal.h5) > doc/film_heat_table.md
	$(PYTHON) post/ehl.py results/film_heat/heated.h5 --case 6 --output doc/figures/ehl_heat.png

study-dynamics: build ## what the accuracy of a flexible train costs: table and figure of doc/dynamics.md, one minute
	@mkdir -p results
	build/release/bin/camroller study decks/dynamics.nml --set sweep.values_1=900,2500 -o results/dynamics_study.h5 > results/dynamics_study.txt
	cp results/dynamics_study.txt doc/dynamics_tables.txt
	$(PYTHON) post/plot_study.py results/dynamics_study.h5 --output doc/figures --name dynamics

audit: build ## influence and cost of each effect of decks/thesis.nml: tables and figure of doc/effects.md, ten seconds
	@mkdir -p results
	build/release/bin/camroller audit decks/thesis.nml -o results/thesis_audit.h5 --repeats 9 > results/thesis_audit.txt
	cp results/thesis_audit.txt doc/effects_tables.txt
	$(PYTHON) post/plot_audit.py results/thesis_audit.h5 --output doc/figures --name thesis_effects
	$(PYTHON) post/plot_audit.py results/thesis_audit.h5 --table

trends: build ## which measured trends the model reproduces over the ranges of uncertain coefficients and laws: doc/trends.md and its figure, two minutes
	@mkdir -p results
	$(PYTHON) post/trends.py --cases results/trends
	build/release/bin/camroller sweep results/trends/trends.nml -o results/trends/trends.h5 --quiet
	build/release/bin/camroller sweep results/trends/trends.nml --set "asperity.mobilisation='stick_slip'" -o results/trends/sticking.h5 --quiet
	build/release/bin/camroller sweep results/trends/pin.nml -o results/trends/pin.h5 --quiet
	$(PYTHON) post/trends.py results/trends/trends.h5 results/trends/sticking.h5 results/trends/pin.h5 --page doc/trends.md --figure doc/figures/trends.png

dynamics: build ## a flexible train at four speeds and over all speeds: figures of doc/dynamics.md, half a minute
	@mkdir -p results
	build/release/bin/camroller run decks/dynamics.nml --set sweep.values_1=300,900,2500,3000 --set numerics.tolerance=1e-4 \
	  -o results/dynamics.h5 --quiet
	$(PYTHON) post/plot.py results/dynamics.h5 --figure train --dpi 90 --output doc/figures
	build/release/bin/camroller sweep decks/lash_adjuster.nml --set sweep.values_1=300,900,2500,3000 --set sweep.series=all \
	  --set numerics.tolerance=1e-4 -o results/adjuster.h5 --quiet
	$(PYTHON) post/plot.py results/dynamics.h5 results/adjuster.h5 --figure dampers --dpi 80 --output doc/figures
	build/release/bin/camroller sweep decks/lash_adjuster.nml --set sweep.values_1=1840,2200,2300 --set sweep.series=all \
	  --set numerics.tolerance=1e-4 -o results/unsteady.h5 --quiet
	$(PYTHON) post/plot.py results/unsteady.h5 --figure turns --dpi 80 --output doc/figures
	build/release/bin/camroller sweep decks/dynamics.nml --set sweep.values_1=$$(seq -s, 500 50 3300) --set sweep.series=all \
	  --set numerics.tolerance=1e-4 -o results/speeds.h5 --quiet
	$(PYTHON) post/campbell.py results/speeds.h5 --dpi 80 --output doc/figures --name dynamics_campbell

install: ## libraries, header, modules and program by CMake, into PREFIX=/usr/local; IO=OFF leaves out what needs HDF5
	@mkdir -p build
	@$(CMAKE) -S . -B build/cmake -DCMAKE_INSTALL_PREFIX="$(or $(PREFIX),/usr/local)" -DCAMROLLER_IO=$(or $(IO),ON) \
	  -DCAMROLLER_BUNDLE_DIR=lib/camroller > build/cmake.log
	@$(CMAKE) --build build/cmake -j2 >> build/cmake.log 2>&1 || { tail -n 20 build/cmake.log; exit 1; }
	@$(CMAKE) --install build/cmake

test: export MPI_LINK_FLAGS := -fno-lto
test: build debug mpi ## all tests, with run-time checks and optimised
	@$(PYTHON) tools/run_tests.py

random: commit ## random cases by two integration methods: CASES=20000 SEED=1; failures print a deck
	@RANDOM_CASES=$(or $(CASES),20000) RANDOM_SEED=$(or $(SEED),1) $(FPM) test --flag "$(OPTIMISED_FLAGS)" -- random_cases

random-ehl: commit ## random cases with a numerical film, as film law and over the cycle: CASES=200 SEED=1, TABLE=1 for a line of each; failures print a deck
	@OPENBLAS_NUM_THREADS=1 RANDOM_EHL_CASES=$(or $(CASES),200) RANDOM_EHL_SEED=$(or $(SEED),1) RANDOM_EHL_TABLE=$(or $(TABLE),0) $(FPM) test \
	  --flag "$(OPTIMISED_FLAGS)" -- random_ehl

random-wide: commit ## random cases with all options of a deck: CASES=20000 SEED=1 FOLDER= for decks that fail
	@WIDE_CASES=$(or $(CASES),20000) WIDE_SEED=$(or $(SEED),1) $(if $(FOLDER),WIDE_FOLDER="$(FOLDER)") $(FPM) test \
	  --flag "$(OPTIMISED_FLAGS)" -- random_wide

random-hosts: commit ## random rigid followers stepped by a host against their runs: CASES=1000 SEED=1 FOLDER= for decks that fail
	@HOST_CASES=$(or $(CASES),1000) HOST_SEED=$(or $(SEED),1) $(if $(FOLDER),WIDE_FOLDER="$(FOLDER)") $(FPM) test \
	  --flag "$(OPTIMISED_FLAGS)" -- random_hosts

step-estimates: commit ## errors of steps of a host beside their estimates, rigid decks at up to POINTS=5 operating points, ten minutes: a table
	@STEP_POINTS=$(or $(POINTS),5) $(FPM) test --flag "$(OPTIMISED_FLAGS)" -- step_estimates

random-flexible: commit ## random flexible trains by two methods: CASES=100 SEED=1 FOLDER= for decks that fail, DECK= for one of them, ACCURACY= in the place of a tolerance of 1e-3
	@FLEXIBLE_CASES=$(or $(CASES),100) FLEXIBLE_SEED=$(or $(SEED),1) $(if $(FOLDER),WIDE_FOLDER="$(FOLDER)") \
	  $(if $(DECK),FLEXIBLE_DECK="$(DECK)") $(if $(ACCURACY),FLEXIBLE_ACCURACY=$(ACCURACY)) $(FPM) test \
	  --flag "$(OPTIMISED_FLAGS)" -- random_flexible

needed: commit ## changes by leaving effects out, compared with their estimates, for random cases: CASES=300 SEED=1
	@NEEDED_TABLE=1 NEEDED_CASES=$(or $(CASES),300) NEEDED_SEED=$(or $(SEED),1) $(FPM) test --flag "$(OPTIMISED_FLAGS)" -- needed

needed-flexible: commit ## the same for random flexible trains: CASES=50 SEED=1
	@NEEDED_TABLE=1 NEEDED_FLEXIBLE=$(or $(CASES),50) NEEDED_SEED=$(or $(SEED),1) $(FPM) test --flag "$(OPTIMISED_FLAGS)" \
	  -- needed_flexible

fuzz: build debug ## malformed decks and files for both builds, outcomes counted: CASES=300 SEED=1 (of each campaign), KIND=decks for one
	@for campaign in $(if $(KIND),test/fuzz/fuzz_$(KIND).py,$(wildcard test/fuzz/fuzz_*.py)); do \
	  $(PYTHON) $$campaign --cases $(or $(CASES),300) --seed $(or $(SEED),1) || failed=1; done; test -z "$$failed"

sanitize: commit ## all decks and Fortran tests with address and undefined-behaviour sanitizers: SUITES="names" DECKS="paths" (40 minutes)
	@$(FPM) install --flag "$(SANITIZE_FLAGS)" --prefix build/sanitize > build/sanitize-build.log 2>&1 || \
	  { cat build/sanitize-build.log; exit 1; }
	@DECKS="$(DECKS)" SUITES="$(SUITES)" $(PYTHON) tools/sanitize.py

faults: commit ## faults planted one at a time, each of which a named test must see, half an hour: ONLY='pattern of the name'
	@$(PYTHON) tools/planted_faults.py $(if $(ONLY),'$(ONLY)')

rough-rows: commit ## comparison with rough contacts of Masjedi and Khonsari: bench/tables/ehl_rough.txt, for doc/notes/numerical_film.md
	@ROUGH_TABLE=bench/tables/ehl_rough.txt $(FPM) test --flag "$(OPTIMISED_FLAGS)" -- ehl_rough

bless: build ## accept the present key results and counters of all decks as reference of test_regression.py
	@BLESS=1 $(PYTHON) -m pytest -q test/python/test_regression.py

quick: commit ## Fortran tests with run-time checks; choose with SUITE=film TEST="..."
	@$(FPM) test --flag "$(DEBUG_FLAGS)" -- $(SUITE) $(if $(TEST),"$(TEST)")

check: check-layers check-style check-format check-lint check-warnings ## layers, style, format, linter, compiler warnings

check-layers: setup
	@$(PYTHON) tools/check_layers.py

check-style: setup
	@$(PYTHON) tools/check_style.py

check-format: setup
	@$(PYTHON) tools/check_format.py

check-lint: setup
	@.venv/bin/fortitude check --quiet --output-format concise $(wildcard src app test example)

check-warnings: commit
	@$(PYTHON) tools/check_warnings.py

second-compiler: setup ## library and tests with flang or a later gfortran, where one is there; SECOND_FC= names it (two minutes)
	@$(PYTHON) tools/second_compiler.py || { code=$$?; [ $$code = 77 ] || exit $$code; }

format: setup ## correct the blanks inside statements
	@$(PYTHON) tools/check_format.py --fix

docs: setup ## API reference and pages as HTML, links checked: build/docs/index.html
	@$(PYTHON) tools/make_docs.py

recipes: setup ## recipes for container, Spack and conda: read by their tools, their build lines run (one minute)
	@$(PYTHON) -m pip install --quiet --disable-pip-version-check -r packaging/requirements.txt
	@FPM=$(CURDIR)/$(FPM) $(PYTHON) tools/check_recipes.py

bench: commit ## time cycles, compared with SUNDIALS and scipy: tables and plots in bench/tables (five minutes)
	@bench/run.sh

bench-dynamics: commit ## a cycle of flexible trains, compared with SUNDIALS and scipy: bench/tables/dynamics_*.txt (ten minutes)
	@bench/run.sh dynamics

bench-ehl: commit ## cost of the numerical film against the number of nodes: bench/tables/ehl_cost.txt and a figure (three minutes)
	@bench/run.sh ehl

range-ehl: commit ## steady contacts over the whole range: NODES=1025, every STRIDE-th from FIRST on; failures and differences are listed
	@bench/run.sh range $(or $(NODES),1025) $(or $(FIRST),1) $(or $(STRIDE),1)

bench-batch: build mpi ## cases per second, scaling, cost as a study grows: bench/tables/throughput.txt (ten minutes, idle machine)
	@$(PYTHON) bench/throughput.py

bench-cases: counted ## where the instructions of a case go: bench/tables/case_cost.txt (two minutes, valgrind)
	@$(PYTHON) bench/case_cost.py build/counted/bin/camroller bench/tables/case_cost.txt build/bench/cases

bench-effects: counted ## instruction counts of effects, present and absent: bench/tables/effects.txt (ten minutes)
	@bench/effects.sh

bench-hosts: setup ## cost of a step of a host, instructions, allocations, time: bench/tables/hosts.txt (ten minutes, valgrind)
	@mkdir -p build/bench && $(MAKE) --no-print-directory install PREFIX=$(CURDIR)/build/bench/prefix IO=OFF > build/bench-hosts.log
	@$(PYTHON) bench/hosts.py build/bench/prefix build/bench/hosts > build/bench/hosts.part && mv build/bench/hosts.part bench/tables/hosts.txt
	@cat bench/tables/hosts.txt

# all but what the set-up and fpm fetch or note there
clean: ## remove built files; keep tools and results
	rm -rf bench/build $(filter-out $(addprefix build/,dependencies pkgconfig cache.toml without-open-mpi),$(wildcard build/*))

distclean: ## remove everything that is not in git, results too
	rm -rf build bench/build .venv results
