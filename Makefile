# The two commands a newcomer needs:
#   make certificate   install what is missing, build, and certify a published design
#   make test          the same for the tests
# and the ones that continuous integration adds: make lint, make sanitize, make fuzz; and make bench.

MAKEFLAGS += --no-print-directory

BUILD_PACKAGES := g++ cmake make pkg-config libeigen3-dev libboost-dev coinor-libipopt-dev libnlopt-cxx-dev \
  libmpfr-dev libtomlplusplus-dev libcli11-dev libfmt-dev nlohmann-json3-dev libtbb-dev gnuplot-nox \
  libflint-arb-dev libflint-dev
# clang also compiles the arithmetic tests: the promise must hold under both compilers
TEST_PACKAGES  := doctest-dev python3-jsonschema clang git
LINT_PACKAGES  := clang-format clang-tidy git
FUZZ_PACKAGES  := clang libclang-rt-14-dev doctest-dev
PROOF_PACKAGES := coq libcoq-interval libcoq-coquelicot
BENCH_PACKAGES := libbenchmark-dev libmpfi-dev

DESIGN       ?= designs/la-scala-1994-figure-3.5.toml
JOBS         ?= $(shell nproc)
FUZZ_SECONDS ?= 60
# One of each kind; make proofs PROOF_DESIGNS="$$(echo designs/*.toml)" takes all of them.
PROOF_DESIGNS ?= designs/praly-section-v-proved-ell.toml designs/praly-section-v.toml \
  designs/la-scala-1994-figure-3.5.toml designs/bittanti-savaresi-2000-example-1.toml

.PHONY: certificate verify proofs test lint format sanitize fuzz bench clean

certificate:
	@scripts/install-packages $(BUILD_PACKAGES)
	@cmake --preset release -DVERITRACK_BUILD_TESTS=OFF >&2
	@cmake --build --preset release --parallel $(JOBS) --target veritrack >&2
	@build/release/veritrack certify $(DESIGN)

# All designs certified, and every certificate checked by a program that shares no code with the one that made it.
verify:
	@scripts/install-packages $(BUILD_PACKAGES)
	@cmake --preset release -DVERITRACK_BUILD_TESTS=OFF >&2
	@cmake --build --preset release --parallel $(JOBS) --target veritrack veritrack-verify >&2
	@scripts/verify build/release designs/*.toml

# Certificates with formal proofs, checked by the proof assistant Coq.
proofs:
	@scripts/install-packages $(BUILD_PACKAGES) $(PROOF_PACKAGES)
	@cmake --preset release >&2
	@cmake --build --preset release --parallel $(JOBS) --target veritrack >&2
	@scripts/proofs "$(CURDIR)/build/release/veritrack" $(PROOF_DESIGNS)

test:
	@scripts/install-packages $(BUILD_PACKAGES) $(TEST_PACKAGES)
	cmake --preset release -DVERITRACK_BUILD_TESTS=ON
	cmake --build --preset release --parallel $(JOBS)
	ctest --preset release --parallel $(JOBS)

lint:
	@scripts/install-packages $(BUILD_PACKAGES) $(TEST_PACKAGES) $(LINT_PACKAGES)
	cmake --preset sanitizers
	scripts/lint build/sanitizers

format:
	git ls-files -- '*.hpp' '*.cpp' | xargs clang-format -i

# The rooms that everything rests on. The others take the interval arithmetic through minutes of search, which the
# sanitizers would make hours of; the design reader goes through the fuzzers, which run under them.
SANITIZED := rigor_tests theorems_tests search_tests trackers_tests trackers_quadrature_tests trackers_single_channel_tests \
  trackers_kkl_observer_tests trackers_signals_tests

sanitize:
	@scripts/install-packages $(BUILD_PACKAGES) $(TEST_PACKAGES) $(FUZZ_PACKAGES)
	cmake --preset sanitizers
	cmake --build --preset sanitizers --parallel $(JOBS) --target $(SANITIZED)
	VERITRACK_TEST_EFFORT=0.02 ctest --preset sanitizers --parallel $(JOBS) \
	  --tests-regex '^($(subst $() $(),|,$(strip $(SANITIZED))))$$'

fuzz:
	@scripts/install-packages $(BUILD_PACKAGES) $(FUZZ_PACKAGES)
	cmake --preset sanitizers -DVERITRACK_BUILD_FUZZERS=ON
	cmake --build --preset sanitizers --parallel $(JOBS) --target fuzzers
	scripts/fuzz build/sanitizers $(FUZZ_SECONDS)

bench:
	@scripts/install-packages $(BUILD_PACKAGES) $(BENCH_PACKAGES)
	cmake --preset release -DVERITRACK_BUILD_BENCH=ON
	cmake --build --preset release --parallel $(JOBS)
	for program in build/release/bench/*_bench; do $$program; done

clean:
	rm -rf build certificates-out
