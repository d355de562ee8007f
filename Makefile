# Everything here works on a fresh machine with make and Python 3.11 or later.
PYTHON ?= python3
DATA ?= ../shared/data
VENV := .venv
BIN := $(VENV)/bin
WORKERS := -n auto --dist loadfile --no-loadscope-reorder
SUITE := tests $(WORKERS) --data=$(DATA) -m "not long"

.PHONY: demo test test-long test-matrix lint types types-windows compiled bench docs web web-test web-check web-types clean

# where the surroundings forbid bytecode, every process of the tests would compile the library anew
export PYTHONDONTWRITEBYTECODE :=

demo: $(VENV)/run.stamp
	$(BIN)/forcetorque demo -o build/demo

test: $(VENV)/test.stamp
	$(MAKE) --no-print-directory --jobs=2 --output-sync=target lint types web-check compiled
	# a worker for every core: threads of their linear algebra would only wait for each other
	OMP_NUM_THREADS=1 $(BIN)/pytest $(SUITE)

test-long: $(VENV)/test.stamp $(VENV)/test-long.stamp $(VENV)/docs.stamp types-windows
	OMP_NUM_THREADS=1 $(BIN)/pytest tests $(WORKERS) --data=$(DATA) -m "long or fuzz" --all-examples

# every Python of pyproject.toml, the oldest with the oldest dependencies; ONLY=3.12 runs one of them
test-matrix: $(BIN)/uv
	OMP_NUM_THREADS=1 $(BIN)/python -m tests.matrix $(if $(ONLY),--only $(ONLY)) $(SUITE)

lint: $(VENV)/test.stamp
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: $(VENV)/test.stamp
	$(BIN)/mypy

# of the long run; each platform has its own cache, for one would make the other's useless
types-windows: $(VENV)/test.stamp
	$(BIN)/mypy --platform win32 --cache-dir .mypy_cache/win32

# what every worker of the tests would else compile for itself, functions and tests; the run shows errors of tests
compiled: $(VENV)/test.stamp
	$(BIN)/python -m tests.compile_ahead
	$(BIN)/pytest tests --collect-only --quiet > /dev/null || true

bench: $(VENV)/test.stamp
	$(BIN)/python -m benchmarks.yarp_readers --json build/benchmarks/yarp_readers.json
	$(BIN)/python -m benchmarks.c3d_files --json build/benchmarks/c3d_files.json
	$(BIN)/python -m benchmarks.force_plates --json build/benchmarks/force_plates.json
	$(BIN)/python -m benchmarks.bags --json build/benchmarks/bags.json
	$(BIN)/python -m benchmarks.arm_logs --json build/benchmarks/arm_logs.json
	$(BIN)/python -m benchmarks.calibration --json build/benchmarks/calibration.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.model_errors --json build/benchmarks/model_errors.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.planned_errors --json build/benchmarks/planned_errors.json
	$(BIN)/python -m benchmarks.dynamics --json build/benchmarks/dynamics.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.dynamics.processor_time --json build/benchmarks/dynamics_processor_time.json
	$(BIN)/python -m benchmarks.simulation --json build/benchmarks/simulation.json
	$(BIN)/python -m benchmarks.joint --json build/benchmarks/joint.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.long_recordings --json build/benchmarks/long_recordings.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.fleet --json build/benchmarks/fleet.json
	$(BIN)/python -m benchmarks.real_logs --json build/benchmarks/real_logs.json
	$(BIN)/python -m benchmarks.skin --json build/benchmarks/skin.json
	$(BIN)/python -m benchmarks.sphere --json build/benchmarks/sphere.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.arm_loads --json build/benchmarks/arm_loads.json
	$(BIN)/python -m benchmarks.viewer --json build/benchmarks/viewer.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.collisions --json build/benchmarks/collisions.json
	OMP_NUM_THREADS=1 $(BIN)/python -m benchmarks.live --json build/benchmarks/live.json

# the pages and the API reference as build/docs/index.html; a warning is an error
docs: $(VENV)/docs.stamp
	$(BIN)/python -m docs.site.layout build/pages
	$(BIN)/sphinx-build --quiet --fail-on-warning --keep-going -c docs/site build/pages build/docs

# the viewer's page, built from web/ and committed: who installs the library needs no npm
web:
	cd web && npm ci && npm run build

web-test:
	cd web && npm ci && npm run lint && npm run types && npm test

web-check: $(VENV)/test.stamp
	$(BIN)/python web/check_bundle.py

# the classes of src/forcetorque/viewer/scene.py, and colours, as the page reads them
web-types: $(VENV)/run.stamp
	$(BIN)/python -m forcetorque.viewer.typescript web/src

# uv installs exactly what uv.lock says; it is itself installed here, so nothing is assumed. Bytecode is made once for
# the first commands; the tests make that of what they import, in `compiled`
$(BIN)/uv:
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "Python 3.11 or later is needed; make PYTHON=...")'
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check "uv>=0.5"

$(VENV)/run.stamp: $(BIN)/uv pyproject.toml uv.lock
	$(BIN)/uv sync --quiet --locked --inexact --compile-bytecode
	touch $@

$(VENV)/test.stamp: $(BIN)/uv pyproject.toml uv.lock
	$(BIN)/uv sync --quiet --locked --inexact --extra test
	touch $@ $(VENV)/run.stamp

$(VENV)/test-long.stamp: $(BIN)/uv pyproject.toml uv.lock
	$(BIN)/uv sync --quiet --locked --inexact --compile-bytecode --extra test --extra test-long
	touch $@ $(VENV)/run.stamp

$(VENV)/docs.stamp: $(BIN)/uv pyproject.toml uv.lock
	$(BIN)/uv sync --quiet --locked --inexact --compile-bytecode --extra docs
	touch $@ $(VENV)/run.stamp

clean:
	rm -rf $(VENV) build
