# The everyday commands. Each installs the packages of packages.txt (Debian 12 and 13) that it needs, builds, and
# does one thing; `make help` lists them.

JOBS ?= $(shell nproc 2>/dev/null || echo 2)
INSTALL = @scripts/install-packages
CONFIGURE = @scripts/configure
NPM = @cd web && { [ -e node_modules/vitepress ] || npm ci --no-audit --no-fund; }

# The tool alone needs no test packages, so a new build folder leaves out the tests until they are requested.
FIRST = $(if $(wildcard build/build.ninja),,-DOUTRIDER_BUILD_TESTS=OFF)

# Tests that read published data find it here; without it they are skipped.
ifneq ($(wildcard ../shared/data),)
export OUTRIDER_DATA ?= $(abspath ../shared/data)
endif

# The names of the tests of some units as a pattern for ctest; without units, of every test.
space := $() $()
tests_of = ^($(subst $(space),|,$(strip $(patsubst %,unit_%,$(1)))))$(if $(1),[.])

FUZZ_SECONDS ?= 60
LOAD_SECONDS ?= 600
MOMENTS ?= 50
RUNS ?= 200
MISSIONS ?= 1000
TIMES ?= 10

.DEFAULT_GOAL := help
.PHONY: help demo build build-times tool-and-page serve pictures test mutants research asan sanitized tsan docs site soak cancel loops replays totality growth flaky writes load hostile fuzz wasm packages check-packages check-debian check-python-asan check-ros2 bench sbom lint tidy check-clang check-format format clean

help:  ## list the verbs
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-18s %s\n", $$1, $$2 }' Makefile

# If npm cannot get its packages, the tool has no page; the picture run.svg does not need npm.
demo: tool-and-page  ## guard the example yard, print the summary, write a page and a picture to out/yard
	@build/outrider run scenarios/yard/yard.yaml --out out/yard $$(grep -qs incbin build/web/page_files.cpp && echo --html)

build:  ## build the tool, build/outrider
	$(INSTALL) build
	$(CONFIGURE) release build -DCMAKE_BUILD_TYPE=Release $(FIRST)
	@ninja -C build -j $(JOBS) outrider manual

tool-and-page:
	$(INSTALL) build page
	$(CONFIGURE) release build -DCMAKE_BUILD_TYPE=Release $(FIRST)
	@ninja -C build -j $(JOBS) outrider

build-times:  ## build the tool anew in build-times, one file at a time, and print which rooms and files cost most
	$(INSTALL) build
	$(CONFIGURE) release build-times -B build-times -DOUTRIDER_TIME_BUILD=ON -DOUTRIDER_BUILD_TESTS=OFF -DOUTRIDER_WITH_PAGE=OFF -DOUTRIDER_WITH_PYTHON=OFF
	@ninja -C build-times clean && rm -f build-times/compile-times.txt && ninja -C build-times -j 1 outrider
	@scripts/build-times build-times

serve: tool-and-page  ## build the tool with its page, and open the scenarios at 127.0.0.1:8080
	@build/outrider serve scenarios

test:  ## build everything and run every test
	$(INSTALL) build test physics cbc page browser python notebook
	$(CONFIGURE) release build -DOUTRIDER_BUILD_TESTS=ON
	@ninja -C build -j $(JOBS)
	@ctest --preset release -j $(JOBS) && echo "Every test passed." || \
	  { echo "Some tests failed; the list above names them."; exit 1; }

mutants: COUNT = 200
mutants: SEED = 1
mutants:  ## change COUNT lines of guard, navigate, path and slam one at a time, 200 unless given, and tell how many of the changes the unit tests find
	$(INSTALL) build test
	@scripts/mutants $(COUNT) $(SEED)

research:  ## build the reference methods of research/ and their tests, and run these; then `outrider research` has them
	$(INSTALL) build test ompl
	$(CONFIGURE) release build -DOUTRIDER_BUILD_TESTS=ON -DOUTRIDER_BUILD_RESEARCH=ON
	@ninja -C build -j $(JOBS) outrider outrider-research unit_research
	@ctest --preset release -j $(JOBS) -R "^cli[.]research|^Research|^Pddl|^Temporal|^Sampling" && echo "Every test of research passed."

flaky: build  ## run the tests that wait for anything TIMES in a row, 10 unless given, beside four busy loops
	$(INSTALL) build test physics cbc page browser python notebook
	$(CONFIGURE) release build -DOUTRIDER_BUILD_TESTS=ON
	@ninja -C build -j $(JOBS) outrider unit_server
	@scripts/flaky $(TIMES) $(JOBS)

# UNITS="io log" runs only the tests of these units.
asan:  ## run the test programs, costly tests in part, under the address and undefined-behaviour sanitizers
	$(INSTALL) build test cbc
	$(CONFIGURE) asan build-asan -DOUTRIDER_BUILD_TESTS=ON -DOUTRIDER_TEST_PARTS=4
	@ninja -C build-asan -j $(JOBS) $(or $(UNITS:%=unit_%),test_programs)
	@OUTRIDER_CASES=0.1 ctest --preset asan -j $(JOBS) -R '$(call tests_of,$(UNITS))' && echo "Every test passed under the sanitizers." || \
	  { echo "Some tests failed under the sanitizers; the list above names them."; exit 1; }

sanitized:  ## run the tests of the layers that read the files of others under these sanitizers, beside the release; a third of the time of asan
	$(INSTALL) build test
	$(CONFIGURE) release build -DOUTRIDER_BUILD_TESTS=ON
	@ninja -C build -j $(JOBS) sanitized
	@for unit in world log io; do for part in 0 1 2 3; do echo $$unit $$part; done; done | \
	  OUTRIDER_CASES=0.1 GTEST_TOTAL_SHARDS=4 xargs -P $(JOBS) -n 2 scripts/run-part && echo "Every test passed under the sanitizers."

check-python-asan:  ## run the tests of the Python package, and the tool beside it, under the sanitizers
	$(INSTALL) build test cbc python
	$(CONFIGURE) asan build-asan -DOUTRIDER_BUILD_TESTS=ON -DOUTRIDER_TEST_PARTS=4
	@ninja -C build-asan -j $(JOBS) outrider outrider_python
	@ctest --preset asan -R '^python[.]package$$' && echo "Nothing was found in the Python package." || \
	  { echo "The sanitizers or the tests found something in the Python package."; exit 1; }

check-ros2:  ## build with ROS 2 over Cyclone DDS, and run the tests of its nodes, some against Fast DDS
	$(INSTALL) build test ros2
	$(CONFIGURE) ros2 build-ros2 -DOUTRIDER_BUILD_TESTS=ON -DOUTRIDER_TEST_PARTS=4
	@ninja -C build-ros2 -j $(JOBS) outrider unit_nodes unit_ros2 fastdds_test
	@ctest --preset ros2 -R '$(call tests_of,nodes ros2)|^FastDds|^ros2[.]' && 	  echo "Every test of ROS 2 passed." || { echo "Some tests of ROS 2 failed; the list above names them."; exit 1; }

# Units in which threads meet, and scripts of the tool; the others run on one thread (architecture.Style checks that).
THREADED_UNITS = core io job jobs_guard jobs_plan path server sweep tour
THREADED = serve serve_plan serve_yard serve_live serve_safety serve_confinement sweep

# UNITS="core server" runs only the tests of these units.
tsan:  ## run the tests of what has threads, costly ones in part, under the thread sanitizer
	$(INSTALL) build test cbc
	$(CONFIGURE) tsan build-tsan -DOUTRIDER_BUILD_TESTS=ON -DOUTRIDER_TEST_PARTS=8
	@ninja -C build-tsan -j $(JOBS) outrider $(patsubst %,unit_%,$(or $(UNITS),$(THREADED_UNITS)))
	@OUTRIDER_CASES=0.1 ctest --preset tsan -j $(JOBS) \
	    -R "$(call tests_of,$(or $(UNITS),$(THREADED_UNITS)))|^cli[.]($(subst $(space),|,$(THREADED)))$$" && \
	  echo "No race was found." || { echo "Some tests failed under the thread sanitizer; the list above names them."; exit 1; }

docs: build  ## write the pages of options and the schemas of scenarios to build/docs
	@ninja -C build docs

soak: CASES = 2
soak:  ## run everything, the tool too, under the sanitizers, random tests on CASES times as many cases, 2 unless given; then fuzz for an hour, load, hostile, cancel, loops, replays, totality and writes
	$(INSTALL) build test cbc
	$(CONFIGURE) asan build-asan -DOUTRIDER_BUILD_TESTS=ON -DOUTRIDER_TEST_PARTS=0
	@ninja -C build-asan -j $(JOBS)
	@OUTRIDER_CASES=$(CASES) ctest --preset soak -j $(JOBS) --timeout 3600
	@$(MAKE) --no-print-directory fuzz FUZZ_SECONDS=$$((3600 * $(JOBS) / $(words $(wildcard tests/fuzz/*_fuzz.cpp))))
	@$(MAKE) --no-print-directory load
	@$(MAKE) --no-print-directory hostile
	@$(MAKE) --no-print-directory cancel
	@$(MAKE) --no-print-directory loops
	@$(MAKE) --no-print-directory replays
	@$(MAKE) --no-print-directory totality
	@$(MAKE) --no-print-directory writes

writes:  ## make each call fail with which a run is written, and each allocation meanwhile, and tell whether its folder stays whole
	$(INSTALL) build test cbc
	$(CONFIGURE) release build -DOUTRIDER_BUILD_TESTS=ON
	@ninja -C build -j $(JOBS) outrider failing_calls
	@OUTRIDER_CASES=100 ctest --preset release -R '^cli[.]write_faults$$' --timeout 3600 --output-on-failure

cancel: build  ## stop scenarios and planners with Ctrl-C and SIGTERM at MOMENTS random moments, 50 unless given; tells the worst latency
	@OUTRIDER=$(CURDIR)/build/outrider OUTRIDER_SOURCE=$(CURDIR) python3 -B tests/cli/cancel_soak.py --moments $(MOMENTS)

totality: RUNS = 20000
totality: build  ## try the keys of every job at the ends of their ranges, beyond them and in pairs, RUNS runs, 20000 unless given
	@OUTRIDER=$(CURDIR)/build/outrider OUTRIDER_SOURCE=$(CURDIR) python3 -B tests/cli/totality_soak.py --runs $(RUNS)

loops: build  ## explore RUNS buildings of equal rooms, 200 unless given, and tell whether a false loop was closed
	@OUTRIDER=$(CURDIR)/build/outrider python3 -B tests/cli/loops_soak.py --runs $(RUNS)

replays: build  ## fly and drive MISSIONS random guard missions again by other code, 1000 unless given, and tell what is wrong
	$(INSTALL) test
	@OUTRIDER=$(CURDIR)/build/outrider /usr/bin/python3 -B tests/cli/replay_soak.py --missions $(MISSIONS)

growth:  ## print the table of docs/benchmarks/growth.md: how counted work and memory grow with the size of a case
	$(INSTALL) build test cbc
	$(CONFIGURE) release build -DOUTRIDER_BUILD_TESTS=ON
	@ninja -C build -j $(JOBS) growth
	@build/tests/growth --table

hostile: build  ## give thousands of hostile files of every format to the verbs that read them; tells which ended badly
	@OUTRIDER=$(CURDIR)/build/outrider OUTRIDER_SOURCE=$(CURDIR) python3 -B tests/cli/hostile_soak.py --jobs $(JOBS)

load: build  ## what strangers do to the server, mixed for LOAD_SECONDS, 600 unless given; tells the memory it took
	@OUTRIDER=$(CURDIR)/build/outrider OUTRIDER_SOURCE=$(CURDIR) python3 -B tests/cli/serve_load.py $(LOAD_SECONDS)

fuzz:  ## run every fuzz target for FUZZ_SECONDS, 60 unless given
	$(INSTALL) build test cbc fuzz
	$(CONFIGURE) fuzz build-fuzz -DOUTRIDER_BUILD_TESTS=ON -DOUTRIDER_FUZZ=ON
	@ninja -C build-fuzz -j $(JOBS) fuzz_programs
	@scripts/fuzz $(FUZZ_SECONDS) $(JOBS)

# The page plans without a server; then the same queries go to it, in Chromium, and to the library, through Python.
wasm:  ## compile the path planners for browsers: build-wasm/planner.wasm, and plan.html, a page that needs nothing else
	$(INSTALL) build wasm page browser python
	$(NPM)
	@cmake -G Ninja -S wasm -B build-wasm --toolchain $(CURDIR)/wasm/toolchain.cmake >/dev/null
	@ninja -C build-wasm -j $(JOBS)
	@node wasm/one_file.mjs build-wasm/planner.wasm build-wasm/plan.html
	$(CONFIGURE) release build -DCMAKE_BUILD_TYPE=Release $(FIRST)
	@ninja -C build -j $(JOBS) outrider_python
	@PYTHONPATH=build/python /usr/bin/python3 wasm/native_costs.py build-wasm/queries.json
	@node web/tests/run.mjs tests/browser/wasm.mjs $(CURDIR)/build-wasm/plan.html $(CURDIR)/build-wasm/queries.json || [ $$? -eq 77 ]

packages:  ## write Debian packages of the tool, the library and the Python package to build/packages
	$(INSTALL) build physics page python
	$(CONFIGURE) release build -DCMAKE_BUILD_TYPE=Release -DOUTRIDER_WITH_CERES=OFF $(FIRST)
	@ninja -C build -j $(JOBS) all
	@cd build && cpack -G DEB

check-packages: packages  ## install the packages in a fresh Debian, use them there, and take them away again
	$(INSTALL) packages
	@scripts/check-packages build/packages

check-debian:  ## make demo and make test on a clone in a fresh Debian, RELEASE=12 or 13; as root
	$(INSTALL) packages
	@scripts/check-debian $(or $(RELEASE),13)

bench:  ## run the benchmarks, and write what they measure to out/bench, from where the docs site draws it
	$(INSTALL) build bench page browser python ompl cbc ceres peers
	$(CONFIGURE) release build -DOUTRIDER_BUILD_BENCH=ON -DOUTRIDER_BUILD_RESEARCH=ON -DOUTRIDER_WITH_CERES=AUTO $(FIRST)
	@ninja -C build -j $(JOBS) bench/all
	@ninja -C build -j $(JOBS) outrider $$([ -e build/bench/call_bench ] && echo outrider_python)
	@/usr/bin/python3 bench/run.py build out/bench

site:  ## build the docs site in out/site, to be served by any web server; OUTRIDER_BENCH names a folder with results of benchmarks
	$(INSTALL) build page python notebook
	$(CONFIGURE) release build -DCMAKE_BUILD_TYPE=Release $(FIRST)
	@ninja -C build -j $(JOBS) outrider_python docs
	$(NPM)
	@cd web && node build/site.mjs ../out/site

sbom: tool-and-page  ## list what the tool is made of, with versions, in out/sbom.json (CycloneDX)
	@mkdir -p out && scripts/sbom build/outrider > out/sbom.json.part && mv out/sbom.json.part out/sbom.json
	@echo "out/sbom.json"

pictures: tool-and-page  ## make the pictures of the README and docs/ anew, from the page
	$(INSTALL) browser picture
	@OUTRIDER=$(CURDIR)/build/outrider OUTRIDER_SOURCE=$(CURDIR) node web/build/example.mjs
	@OUTRIDER=$(CURDIR)/build/outrider OUTRIDER_SOURCE=$(CURDIR) node web/tests/run.mjs tests/browser/pictures.mjs

lint: check-format  ## static analysis and formatting
	$(INSTALL) build test lint
	$(CONFIGURE) tidy build-tidy -DOUTRIDER_BUILD_TESTS=ON
	@scripts/check-clang build-tidy
	@run-clang-tidy-19 -quiet -p build-tidy -j $(JOBS) "$(CURDIR)/(src|apps)/.*" 2>/dev/null

# Older lines and headers are left to lint, which checks every file.
tidy:  ## static analysis of the lines of the library and the tool that differ from the commit BASE, HEAD~1 unless given
	$(INSTALL) build test lint
	$(CONFIGURE) tidy build-tidy -DOUTRIDER_BUILD_TESTS=ON
	@[ -z "$$(scripts/changed-sources $(or $(BASE),HEAD~1))" ] || git diff -M -U0 $(or $(BASE),HEAD~1) -- src apps | \
	  clang-tidy-diff-19.py -clang-tidy-binary clang-tidy-19 -p1 -path build-tidy -iregex '.*[.]cpp' -j $(JOBS) -quiet

# Checks what changed lately with clang++-19, as the build joins it; lint checks everything.
check-clang:
	$(INSTALL) build test lint
	$(CONFIGURE) release build -DOUTRIDER_BUILD_TESTS=ON
	@scripts/check-clang build --changed

check-format:
	$(INSTALL) format
	@scripts/sources | xargs clang-format-19 --dry-run -Werror

format:  ## format every C++ file
	$(INSTALL) format
	@scripts/sources | xargs clang-format-19 -i

clean:  ## remove everything that was built or written by a run
	@rm -rf build build-* out web/node_modules
