# make demo   install what is missing, build, light a town (CITY=path TIME=... for your own)
# make test   the same set-up, then every test
# make stability  methods against hazards with the long cells; writes docs/stability.md
# make build  only build; make check: what to pass before a merge
#
# CITY  a scene file: CityJSON, CityJSONSeq, OBJ, any of them gzipped
# TIME  2026-06-21T09:00+09:00, or without the offset for the solar time of the place

JOBS ?= $(shell nproc)
ifneq ($(wildcard ../shared/data),)
export TENKU_DATA ?= $(abspath ../shared/data)
endif

.PHONY: demo test stability install build check clean

demo: build
	build/release/cli/tenku run $(if $(CITY),scenes/examples/any_city.toml --scene "$(CITY)",scenes/examples/demo.toml) $(if $(TIME),--time "$(TIME)") --out out/demo || [ $$? -eq 3 ]  # 3: written, some points less exact than asked

test: build
	cmake --preset sanitize
	cmake --build --preset sanitize -j $(JOBS) --target reader_tests
	ctest --preset release -j 2
	ctest --preset sanitize -L reader -j 2

# The stability matrix with its long cells, and docs/stability.md from what it came to.
stability: build
	TENKU_STABILITY_LONG=1 build/release/tests/stability/test_stability --gtest_filter='*Matrix*' > build/stability.txt; \
	  status=$$?; python3 tests/stability/stability_table.py build/stability.txt docs/stability.md; exit $$status

build: install
	cmake --preset release
	cmake --build --preset release -j $(JOBS)

install:
	@.ci/install.sh

check: install
	.ci/check.sh

clean:
	rm -rf build out
