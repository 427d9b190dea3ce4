# The two commands a newcomer needs:
#   make certificate   install what is missing, build, and certify a design
#   make test          the same for the tests
# the one that a sceptic needs:
#   make checker       install what is missing, build the checker alone, and verify a certificate
# and the ones that continuous integration adds: make lint, sanitize, fuzz, verify, proofs, mutation; and make bench.

MAKEFLAGS += --no-print-directory

# What the checker is built with, and nothing else: five libraries and the tools.
CHECKER_PACKAGES := g++ cmake make pkg-config libflint-arb-dev libflint-dev libmpfr-dev nlohmann-json3-dev nettle-dev \
  libtomlplusplus-dev
BUILD_PACKAGES := $(CHECKER_PACKAGES) ninja-build libeigen3-dev coinor-libipopt-dev liblapack-dev libnlopt-cxx-dev libcli11-dev libfmt-dev \
  libtbb-dev gnuplot-nox tao-pegtl-dev libsndfile1-dev libcmark-gfm-dev libcmark-gfm-extensions-dev \
  libkainjow-mustache-dev libpugixml-dev libjs-katex
# From C to a listing: clang compiles, LLVM reads what it made.
LIFT_PACKAGES  := llvm-14-dev clang
# clang also compiles the arithmetic tests: the promise must hold under both compilers
TEST_PACKAGES  := doctest-dev libboost-dev python3-jsonschema python3-yaml clang git
# The package for Python: what it is built with, and what it and its tests run with (sweeps: Dask, Matplotlib, Sobol points)
PYTHON_PACKAGES := pybind11-dev python3-dev python3-numpy
PYTHON_TEST_PACKAGES := $(PYTHON_PACKAGES) python3-pytest python3-distributed python3-matplotlib python3-scipy \
  python3-pip python3-venv python3-setuptools python3-wheel
# types, and the notebook of docs/, by night
PYTHON_NIGHTLY_PACKAGES := mypy python3-nbconvert python3-ipykernel
# a microcontroller: its compiler, its library and an emulator, by night
BOARD_PACKAGES := gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm
LINT_PACKAGES  := clang clang-format clang-tidy git $(PYTHON_PACKAGES)
FUZZ_PACKAGES  := clang libclang-rt-14-dev doctest-dev
PROOF_PACKAGES := coq libcoq-interval libcoq-coquelicot
BENCH_PACKAGES := libbenchmark-dev libboost-dev libmpfi-dev
# a browser for the pages, LaTeX for the tables, and npm for what tests/pages/package.json names (node's own where it is)
PAGE_PACKAGES  := chromium texlive-latex-recommended $(if $(shell command -v npm),,npm)
# dpkg-shlibdeps, which finds what the package needs
DEB_PACKAGES   := dpkg-dev file

CERTIFICATE  ?= tests/certificates/accepted/contraction.json
DESIGN       ?= designs/motor-tone-8-khz.toml
JOBS         ?= $(shell nproc)
FUZZ_SECONDS ?= 30
# nightly: with the tests that take long and rarely fail
TEST_PRESET  ?= release
# How long random tests are: .ci/nightly draws more.
VERITRACK_TEST_EFFORT ?= 0.3
# The same paths each time, so that what lands does not hang on a draw; the nightly run draws.
FUZZ_SEED ?= 1
SANITIZED_EFFORT ?= 0.02
LINT_SCOPE   ?= --changed
# One of each kind, because all of them take long; .ci/nightly takes all. Of those with a leak in Gaussian noise the one that
# takes half of the time; of the models the one that takes seconds, and a loop whose frequency moves.
VERIFY_DESIGNS ?= $(subst 3.3-with-leak-at-22,3.4-with-leak-at-22,$(shell scripts/one-of-each-kind)) designs/models/aranovskiy.toml tests/certificates/model-moving.toml designs/regulator/rotor-two-axes.toml designs/praly-section-v-proved-ell.toml designs/block/la-scala-1994-set-3.toml
# One of each kind, and one of the four of Table 3.2 with a theorem about their recursion; .ci/nightly takes all.
PROOF_DESIGNS  ?= designs/praly-section-v-proved-ell.toml designs/la-scala-1994-figure-3.5.toml \
  designs/la-scala-1994-figure-3.5-without-leak.toml designs/bittanti-savaresi-2000-example-1.toml
# --whole: each file as it stands, not in two parts
PROOF_OPTIONS  ?=

.PHONY: certificate checker programs verify proofs pages test lint format sanitize fuzz mutation bench wheel deb clean

# Both programs for the tracker of the design (a build for all stays one); make programs builds them for all.
certificate:
	@scripts/install-packages $(BUILD_PACKAGES)
	@cmake --preset release -DVERITRACK_BUILD_TESTS=OFF -DVERITRACK_BUILD_PYTHON=OFF \
	  -DVERITRACK_TRACKERS="$$(scripts/trackers-of $(DESIGN) build/release)" >&2
	@cmake --build --preset release --parallel $(JOBS) --target veritrack veritrack-verify >&2
	@build/release/veritrack certify $(DESIGN)

# The checker alone (checker/README.md), which shares no code with the rest, as a project of its own in build/checker.
checker:
	@scripts/install-packages $(CHECKER_PACKAGES)
	@cmake -S checker -B build/checker >&2
	@cmake --build build/checker --parallel $(JOBS) >&2
	@build/checker/veritrack-verify $(CERTIFICATE)

# All programs, for every tracker. The targets below run them: make -j2 --output-sync verify proofs builds it once, and then runs both side by side.
programs:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) python3-jsonschema
	@cmake --preset release -DVERITRACK_BUILD_TESTS=OFF -DVERITRACK_TRACKERS= >&2
	@cmake --build --preset release --parallel $(JOBS) --target veritrack veritrack-verify veritrack-reproduce \
	  veritrack-lift >&2

# Designs certified, and every certificate checked by a program that shares no code with the one that made it.
verify: programs
	@scripts/verify build/release $(VERIFY_DESIGNS)

# Certificates with formal proofs, checked by the proof assistant Coq: accepted as written, refused when changed.
proofs: programs
	@scripts/install-packages $(PROOF_PACKAGES)
	@scripts/proofs $(PROOF_OPTIONS) "$(CURDIR)/build/release/veritrack" $(PROOF_DESIGNS)
	@VERITRACK="$(CURDIR)/build/release/veritrack" python3 -B tests/cli/proofs_test.py

# Pages in a browser, formulas rendered, tables through LaTeX: minutes, and large packages.
pages:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(PAGE_PACKAGES)
	@cmake --preset release -DVERITRACK_BUILD_TESTS=OFF -DVERITRACK_TRACKERS= >&2
	@cmake --build --preset release --parallel $(JOBS) --target veritrack veritrack-verify veritrack-reproduce \
	  veritrack-lift >&2
	@scripts/test-pages build/release/veritrack

test:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(TEST_PACKAGES) $(PYTHON_TEST_PACKAGES) \
	  $(if $(filter nightly,$(TEST_PRESET)),$(PYTHON_NIGHTLY_PACKAGES) $(BOARD_PACKAGES))
	cmake --preset release -DVERITRACK_BUILD_TESTS=ON -DVERITRACK_BUILD_PYTHON=ON -DVERITRACK_TRACKERS=
	cmake --build --preset release --parallel $(JOBS)
	VERITRACK_TEST_EFFORT=$(VERITRACK_TEST_EFFORT) ctest --preset $(TEST_PRESET) --parallel $(JOBS)

lint:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(LINT_PACKAGES)
	cmake --preset lint
	scripts/lint build/lint $(LINT_SCOPE)

format:
	git ls-files -- '*.hpp' '*.cpp' | xargs clang-format -i

# The rooms that everything rests on. The others take the interval arithmetic through minutes of search, which the
# sanitizers would make hours of; the design reader goes through the fuzzers, which run under them.
SANITIZED := rigor_tests statements_tests theorems_tests search_tests trackers_tests trackers_quadrature_tests \
  trackers_single_channel_tests trackers_kkl_observer_tests trackers_signals_tests

sanitize:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(TEST_PACKAGES) $(FUZZ_PACKAGES)
	cmake --preset sanitizers
	cmake --build --preset sanitizers --parallel $(JOBS) --target $(SANITIZED)
	VERITRACK_TEST_EFFORT=$(SANITIZED_EFFORT) ctest --preset sanitizers --parallel $(JOBS) \
	  --tests-regex '^($(subst $() $(),|,$(strip $(SANITIZED))))$$'

fuzz:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(TEST_PACKAGES) $(FUZZ_PACKAGES)
	cmake --preset sanitizers
	cmake --build --preset sanitizers --parallel $(JOBS) --target fuzzers
	scripts/fuzz build/sanitizers $(FUZZ_SECONDS) $(FUZZ_SEED)

# Each guard of analysis/ and checker/ made true, to see whether a test of its room notices. Some hours on two cores.
MUTATION_EFFORT ?= 0.4
MUTATION_ROOMS  ?= analysis checker
# K/N: every N-th guard from the K-th on. All take hours; .ci/nightly takes every eighth.
MUTATION_PART   ?= 0/1

mutation:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(TEST_PACKAGES) python3
	cmake --preset mutation
	cmake --build --preset mutation --parallel $(JOBS)
	VERITRACK_TEST_EFFORT=$(MUTATION_EFFORT) scripts/mutation build/mutation --jobs $(JOBS) --rooms $(MUTATION_ROOMS) \
	  --part $(MUTATION_PART) --known tests/known-mutants.txt

bench:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(BENCH_PACKAGES)
	cmake --preset release -DVERITRACK_BUILD_BENCH=ON -DVERITRACK_TRACKERS=
	cmake --build --preset release --parallel $(JOBS)
	for program in build/release/bench/*_bench; do $$program; done

# The package for Python as a wheel for this platform, in build/wheels (docs/python.md).
wheel:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(PYTHON_PACKAGES) python3-pip python3-setuptools python3-wheel
	@cmake --preset release -DVERITRACK_BUILD_PYTHON=ON -DVERITRACK_TRACKERS= >&2
	@VERITRACK_BUILD_FOLDER="$(CURDIR)/build/release" /usr/bin/python3 -m pip wheel --quiet --no-build-isolation --no-deps \
	  --wheel-dir build/wheels . >&2
	@ls build/wheels/*.whl

# The programs as a Debian package, in build/release/packages. scripts/try-deb installs it into an empty Debian.
deb:
	@scripts/install-packages $(BUILD_PACKAGES) $(LIFT_PACKAGES) $(DEB_PACKAGES)
	@cmake --preset release -DVERITRACK_BUILD_TESTS=OFF -DVERITRACK_TRACKERS= >&2
	@cmake --build --preset release --parallel $(JOBS) --target veritrack veritrack-verify veritrack-reproduce \
	  veritrack-lift veritrack_manual_files >&2
	@cpack --config build/release/CPackConfig.cmake >&2
	@ls build/release/packages/*.deb

clean:
	rm -rf build certificates-out maps-out tracks-out sweeps-out python/veritrack.egg-info tests/pages/node_modules
