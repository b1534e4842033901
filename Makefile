# One virtual environment, made once and remade when its inputs change.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
# The version stands in __init__.py.
INPUTS := pyproject.toml constraints.txt src/memorymaze/__init__.py scripts/setup.sh \
	scripts/setup_node_packages.sh
WORKERS ?= 0
# Results belong to the code that made them, so each version has a run folder of its own.
VERSION := $(shell git rev-parse --short HEAD 2>/dev/null || echo release)
RUN ?= runs/guide-$(VERSION)
# Of `make table-two`: which model (none replays what is recorded), how many episodes of
# each method it is asked for, and where.
MODEL ?=
LIMIT ?= 12
TABLE_TWO ?= runs/table-two-$(VERSION)
OPTIONS ?=
SETTINGS ?=

.PHONY: benchmark table-two test proof test-local-llm check docs wheel-check bench setup install clean

benchmark: install
	$(BIN)/memorymaze benchmark --workers $(WORKERS) --out $(RUN)

# Every method of the paper's Table II, from recorded answers or on a sample with any model,
# which is asked and then replayed from its replies: that must give the same table. OPTIONS
# takes further options of asking it, such as "--base-url URL --price 0.15,0.60", and SETTINGS
# those that change results, for both, such as "--with inference_time=2".
SUITE := $(BIN)/memorymaze evaluate --resume --suite examples/suites
SMALL := $(filter smollm2 gguf:%,$(MODEL))
ASKED := $(SUITE)/$(if $(SMALL),table_two_small,table_two_asked).toml \
	--model "$(MODEL)" --limit $(LIMIT) $(SETTINGS)
table-two: install
ifeq ($(MODEL),)
	$(SUITE)/table_two.toml --workers $(WORKERS) --out $(TABLE_TWO)/recorded
else
ifneq ($(SMALL),)
	$(BIN)/python -c 'import llama_cpp' 2>/dev/null || $(BIN)/python -m pip install --quiet \
		--disable-pip-version-check --constraint constraints.txt --editable '.[local-llm]'
endif
	$(ASKED) --record $(TABLE_TWO)/replies.jsonl $(OPTIONS) --out $(TABLE_TWO)/asked
	$(ASKED) --replay $(TABLE_TWO)/replies.jsonl --out $(TABLE_TWO)/replayed > /dev/null
	cmp $(TABLE_TWO)/asked/II.csv $(TABLE_TWO)/replayed/II.csv
	@echo "replayed from $(TABLE_TWO)/replies.jsonl: the same table"
endif

# One more than there are cores, as some tests wait for browsers and processes. Bytecode is
# kept, or each of the many processes that tests start would compile all anew.
TESTERS := $(shell expr $$(getconf _NPROCESSORS_ONLN) + 1)
PYTEST := PYTHONDONTWRITEBYTECODE= $(BIN)/pytest -n $(TESTERS) --dist worksteal

test: setup
	$(PYTEST)

# What takes too long for every change: long runs, kills, load, browsers, many buildings,
# properties by many examples; and the tests with a language model, where
# `make test-local-llm` has set one up.
proof: setup
	$(PYTEST) -m "(proof or hypothesis) and not local_llm" \
		--hypothesis-profile thorough
	if $(BIN)/python -c 'import llama_cpp' 2>/dev/null; then $(BIN)/pytest -n 0 -m local_llm tests; fi

# Compiles llama.cpp the first time, which takes minutes and needs CMake and a compiler.
test-local-llm: setup
	$(BIN)/python -m pip install --quiet --disable-pip-version-check \
		--constraint constraints.txt --group local-llm-test
	$(BIN)/pytest -n 0 -m local_llm tests

check: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/codespell README.md CHANGELOG.md CONTRIBUTING.md docs src tests benchmarks examples scripts
	$(BIN)/pyright
	$(BIN)/lint-imports
	$(PYTEST)

# The pages as a site, in site/; fails where a link leads nowhere.
docs: setup
	$(BIN)/python -m pip install --quiet --disable-pip-version-check \
		--constraint constraints.txt --group docs
	$(BIN)/mkdocs build

# What a release would hand out, into dist/, and tried in an environment outside of here.
wheel-check: setup
	$(BIN)/python scripts/check_release.py

bench: setup
	$(BIN)/python -m benchmarks

# The package alone, to run it.
install: $(VENV)/.installed

# The package with all that tests and checks need.
setup: $(VENV)/.ready

$(VENV)/.installed: $(INPUTS)
	bash scripts/setup.sh "$(PYTHON)" "$(VENV)" run
	touch $@

$(VENV)/.ready: $(INPUTS)
	bash scripts/setup.sh "$(PYTHON)" "$(VENV)" develop
	touch $@ $(VENV)/.installed

clean:
	rm -rf $(VENV) dist site runs .pytest_cache .ruff_cache .hypothesis .import_linter_cache
