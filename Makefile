# SPDX-License-Identifier: GPL-3.0-or-later
# Everything from a fresh Debian 12: `make demo`, `make test`. CMake does the building.
SHELL := /bin/bash
JOBS ?= $(shell nproc)
PROGRAM := build/release/bin/hyperex

.DEFAULT_GOAL := help
.PHONY: help demo test build install python deb asan tsan coverage lint fresh docs fuzz bench experiments fidelity muscles mutations interop mutants clean setup

# Where HOME cannot be written to (a service, a container) the compiler's cache stands here.
ifneq ($(shell test -w "$$HOME" && echo yes),yes)
export CCACHE_DIR ?= $(CURDIR)/build/ccache
endif
# Handed to cmake: CI sets -DHYPEREX_WERROR=ON.
CMAKE_OPTIONS ?=

help: ## this list
	@echo "make TARGET, where TARGET is one of"
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/  \1\t\2/p' Makefile | expand -t 15

demo: build ## one smile, then the same pull with a weak nerve branch and with a stiff scar, in millimetres
	$(PROGRAM) run examples/demo.toml --out out/demo
	@echo
	@echo "One smile, then the same pull with a weak nerve branch and with a stiff scar. Open in a browser,"
	@echo "and press Side by side:"
	@echo "  $(CURDIR)/out/demo/report.html"
	@echo "In Blender or any glTF viewer: out/demo/performance.glb; in ParaView: out/demo/frames.pvd"
	@echo "(there the filter Warp By Vector moves the tissue)."
	@echo "To pull the muscles yourself: $(PROGRAM) studio examples/demo.toml"
	@echo "Your own face next: $(PROGRAM) new SCAN MOTION writes a scene to start from."

build: setup ## the program alone: build/release/bin/hyperex
	cmake --preset release $(CMAKE_OPTIONS)
	cmake --build --preset release --parallel $(JOBS) --target hyperex

PREFIX ?= /usr/local
install: build ## the program and the C++ library into PREFIX (docs/library.md)
	cmake --build --preset release --parallel $(JOBS) --target libhyperex
	cmake --install build/release --prefix $(PREFIX)

# Debian's python3 looks for packages below /usr/local; for another PREFIX set PYTHONPATH (docs/python.md).
python: ## the Python module into PREFIX, where Debian's python3 finds it (docs/python.md)
	scripts/setup.sh --python
	cmake --preset release -DHYPEREX_PYTHON=ON $(CMAKE_OPTIONS)
	cmake --build --preset release --parallel $(JOBS) --target hyperex_python
	cmake --install build/release --component python --prefix $(PREFIX)

# Packages of Debian's own put modules of Python elsewhere than /usr/local does.
deb: ## Debian packages of program, C++ library and Python module: build/deb/*.deb
	scripts/setup.sh --deb
	cmake --preset release -B build/deb -DHYPEREX_TESTS=OFF -DHYPEREX_PYTHON=ON \
	  -DHYPEREX_PYTHON_FOLDER=lib/python3/dist-packages -DHYPEREX_DEB=ON $(CMAKE_OPTIONS)
	cmake --build build/deb --parallel $(JOBS) --target hyperex libhyperex hyperex_python man
	rm -f build/deb/*.deb
	cd build/deb && cpack --config CPackConfig.cmake && rm -rf _CPack_Packages
	@ls -l build/deb/*.deb

test: ## everything: unit tests, verification, the demo twice, its replay in a browser
	scripts/setup.sh --tests
	cmake --preset release -DHYPEREX_TESTS=ON $(CMAKE_OPTIONS)
	cmake --build --preset release --parallel $(JOBS)
	ctest --preset release --parallel $(JOBS)

asan: ## the tests again under the address and undefined-behaviour sanitizers
	scripts/setup.sh --tests
	cmake --preset asan
	cmake --build --preset asan --parallel $(JOBS)
	ctest --preset asan --parallel $(JOBS)

# GCC 12's thread sanitizer knows fewer random addresses than newer kernels use.
FIXED_ADDRESSES := $(shell setarch -R true 2> /dev/null && echo setarch -R)
# Programs of tests are run while they are built: they list their tests.
# Files of OpenNI2 are recorded in a fork, where the sanitizer allows no threads. On one core TBB, which is not built
# with the sanitizer, starts no threads of its own, and so only ours are judged.
ONE_CORE := $(shell taskset -c 0 true 2> /dev/null && echo taskset -c 0)
tsan: export TSAN_OPTIONS = suppressions='$(CURDIR)/tests/support/races.supp' print_suppressions=0
tsan: ## capture, live tracking, the studio, interrupts and simulators side by side under the thread sanitizer
	scripts/setup.sh --tests
	cmake --preset tsan -DHYPEREX_TESTS=ON
	$(FIXED_ADDRESSES) cmake --build --preset tsan --parallel $(JOBS) --target \
	  hyperex test_core test_capture test_capture_openni test_tracking_live test_simulate test_apps \
	  test_studio test_studio_live
	$(FIXED_ADDRESSES) ctest --preset tsan --parallel $(JOBS) --no-tests=error \
	  -R '^(core|capture|capture_openni|tracking_live)\.' -E '^capture_openni\.OniFile'
	$(ONE_CORE) $(FIXED_ADDRESSES) ctest --preset tsan --no-tests=error \
	  -R '^apps\.(Interrupted|TrackLive)|^simulate\.(SimulatorOfAFace|MouthContactOfAFace)\.Copies|^studio\.(StudioServer|RequestQueue)|^studio_live\.LiveFace'

coverage: ## which lines the tests run: a table by room, build/coverage/report/index.html in full
	scripts/setup.sh --lint
	cmake --preset coverage -DHYPEREX_TESTS=ON
	cmake --build --preset coverage --parallel $(JOBS)
	find build/coverage -name '*.gcda' -delete
	ctest --preset coverage --parallel $(JOBS) || true
	scripts/coverage.sh

lint: ## formatting, words and clang-tidy over everything (some 30 minutes of CPU)
	scripts/setup.sh --lint
	cmake --preset lint
	cmake --build --preset lint --target hx_generated
	scripts/lint.sh

fresh: ## all this on an empty Debian 12, as root and as a user with sudo (needs root; COLD=1: no caches; PACKAGES=1: make deb, used there)
	scripts/fresh.sh $(if $(COLD),--cold) $(if $(PACKAGES),--packages)

fuzz: ## fuzz every reader of files with libFuzzer, 10 minutes each (SECONDS_EACH=5: a look)
	scripts/setup.sh --fuzz
	cmake --preset fuzz
	cmake --build --preset fuzz --parallel $(JOBS)
	JOBS=$(JOBS) RUNS_EACH=$(RUNS_EACH) tests/fuzz/run.sh $(or $(SECONDS_EACH),600)

mutants: ## broken inputs of every format through the whole program, under the sanitizers (COUNT=5 of each)
	scripts/setup.sh --tests
	cmake --preset asan -B build/asan_program -DHYPEREX_TESTS=OFF
	cmake --build build/asan_program --parallel $(JOBS) --target hyperex
	python3 tests/fuzz/mutate_program.py --program build/asan_program/bin/hyperex --count $(or $(COUNT),5)

bench: ## measure everything, beside CalculiX, and write docs/performance.md (QUICK=1: a look)
	scripts/setup.sh --bench
	cmake --preset release
	cmake --build --preset release --parallel $(JOBS) --target \
	  assembly_bench solver_bench reduced_bench memory_bench growth_bench tracking_bench
	bench/run.sh build/release $(if $(QUICK),--quick)

experiments: build ## the thesis' three experiments and twin experiments: reports, docs/experiments.md (subject A too where ../shared is), docs/twins.md
	cmake --build --preset release --parallel $(JOBS) --target experiments_study twins_study
	bench/experiments/run.sh build/release

fidelity: build ## errors against true faces, into the table of docs/fidelity.md (needs the data in ../shared)
	cmake --build --preset release --parallel $(JOBS) --target test_fidelity
	HYPEREX_FIDELITY_PAGE=$(CURDIR)/docs/fidelity.md build/release/bin/test_fidelity --gtest_filter=Fidelity.TableIsWritten

# WITH: arguments of muscle_bench, as WITH="tissue_alone=1 kind=7".
muscles: setup ## errors of many expressions moved by muscles, of docs/muscles.md (needs the data in ../shared)
	cmake --preset release $(CMAKE_OPTIONS)
	cmake --build --preset release --parallel $(JOBS) --target muscle_bench
	test -e build/muscles/cases.txt || bench/rig_cases.py ../shared/data build/muscles
	build/release/bin/muscle_bench build/muscles/cases.txt $(WITH)

docs: setup ## the documentation as a site that needs no network: build/docs/html/index.html
	scripts/setup.sh --docs
	cmake --preset release -DHYPEREX_PYTHON=ON $(CMAKE_OPTIONS)
	cmake --build --preset release --parallel $(JOBS) --target hyperex_python
	docs/site/build.sh build/docs build/release/python

mutations: ## perturb formulas one at a time and show that a test fails for each (ONLY=name: some)
	tests/mutations/run.sh $(ONLY)

interop: build ## every example opened in ParaView, VTK and Blender, its glTF and Slicer landmarks checked; the tutorials, a study by Snakemake and Slurm
	scripts/setup.sh --interop
	cmake --preset release -DHYPEREX_PYTHON=ON $(CMAKE_OPTIONS)
	cmake --build --preset release --parallel $(JOBS) --target hyperex_python
	tests/interop/run.sh $(PROGRAM)
	for page in docs/tutorials/*.md; do \
	  /usr/bin/python3 tests/docs/run_page.py $$page --bin build/release/bin --module build/release/python || exit 1; done
	tests/schedulers/snakemake_test.sh $(PROGRAM)
	tests/schedulers/slurm_test.sh $(PROGRAM)

setup: ## install what building takes (asks for sudo where you are not root)
	scripts/setup.sh

clean: ## remove everything that was built or computed here
	rm -rf build out web/dist
