# One virtual environment, made once and remade when its inputs change.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
INPUTS := pyproject.toml constraints.txt scripts/setup.sh scripts/setup_node_packages.sh
WORKERS ?= 0
# Results belong to the code that made them, so each version has a run folder of its own.
VERSION := $(shell git rev-parse --short HEAD 2>/dev/null || echo release)
RUN ?= runs/guide-$(VERSION)
# Of `make table-two`: which model (none replays what is recorded), how many episodes of
# each method it is asked for, and where.
MODEL ?=
LIMIT ?= 12
TABLE_TWO ?= runs/table-two-$(VERSION)

.PHONY: benchmark table-two test proof test-local-llm check bench setup install clean

benchmark: install
	$(BIN)/memorymaze evaluate --agent guide --workers $(WORKERS) --out $(RUN) --resume
	$(BIN)/memorymaze table $(RUN)

# Every method of the paper's Table II, from recorded answers or on a sample with any model.
table-two: install
	bash scripts/table_two.sh "$(BIN)" "$(MODEL)" "$(LIMIT)" "$(TABLE_TWO)"

test: setup
	$(BIN)/pytest -n auto

# What takes too long for every change: long runs, kills, load, browsers, many buildings;
# and the tests with a language model, where `make test-local-llm` has set one up.
proof: setup
	$(BIN)/pytest -n auto -m proof
	if $(BIN)/python -c 'import llama_cpp' 2>/dev/null; then $(BIN)/pytest -n 0 -m local_llm tests; fi

# Compiles llama.cpp the first time, which takes minutes and needs CMake and a compiler.
test-local-llm: setup
	$(BIN)/python -m pip install --quiet --disable-pip-version-check \
		--constraint constraints.txt --group local-llm-test
	$(BIN)/pytest -n 0 -m local_llm tests

check: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/codespell README.md CHANGELOG.md docs src tests benchmarks examples scripts
	$(BIN)/pyright
	$(BIN)/lint-imports
	$(BIN)/pytest -n auto

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
	rm -rf $(VENV) runs .pytest_cache .ruff_cache .hypothesis .import_linter_cache
