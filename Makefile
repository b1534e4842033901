# One virtual environment, made once and remade when its inputs change.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/.ready
WORKERS ?= 0
# Results belong to the code that made them, so each version has a run folder of its own.
RUN ?= runs/rules-$(shell git rev-parse --short HEAD 2>/dev/null || echo release)

.PHONY: benchmark test test-local-llm check bench setup clean

benchmark: setup
	$(BIN)/memorymaze evaluate --agent rules --workers $(WORKERS) --out $(RUN) --resume
	$(BIN)/memorymaze table $(RUN)

test: setup
	$(BIN)/pytest -n auto

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

setup: $(READY)

$(READY): pyproject.toml constraints.txt scripts/setup.sh
	bash scripts/setup.sh "$(PYTHON)" "$(VENV)"
	touch $@

clean:
	rm -rf $(VENV) runs .pytest_cache .ruff_cache .hypothesis .import_linter_cache
