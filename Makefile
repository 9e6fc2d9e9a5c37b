# make demo   sets up .venv and retargets the built-in performance onto the built-in faces
# make test   sets up .venv and runs all tests but those that need a window
# make gui-test   plays in the window of a real Blender: as root, for it makes one from Debian's packages
PYTHON ?= python3.11
BIN := .venv/bin
DEMO ?= build/demo
export OMP_NUM_THREADS ?= 2

.PHONY: demo test test-blenders gui-test pictures lint zip bench pins clean
.DELETE_ON_ERROR:

.venv/ready: requirements/develop.txt pyproject.toml
	$(PYTHON) -m venv --clear .venv
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements/develop.txt
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	touch $@

demo: .venv/ready
	$(BIN)/facial-retarget demo $(DEMO)
	$(BIN)/python docs/samples/05_demo_scene.py $(DEMO)
	$(BIN)/python docs/samples/10_figure_11.py $(DEMO)
	$(BIN)/python docs/samples/13_wrinkle_kit.py $(DEMO)

test: .venv/ready
	$(BIN)/python -m pytest --ignore=tests/gui

# The same Blender tests in the oldest and the newest Blender that are supported.
.venv-%/ready: requirements/blender-%.txt
	$(if $(filter 5.2,$*),python3.13,$(PYTHON)) -m venv --clear .venv-$*
	.venv-$*/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r $<
	touch $@

BLENDERS ?= 4.5 5.2
test-blenders: .venv/ready $(BLENDERS:%=.venv-%/ready)
	FACIAL_RETARGET_BLENDER_PYTHONS="$(subst $() ,:,$(BLENDERS:%=$(CURDIR)/.venv-%/bin/python))" \
	    $(BIN)/python -m pytest tests/blender

export FACIAL_RETARGET_BLENDER_ROOT ?= $(CURDIR)/build/blender-root
gui-test: .venv/ready
	tests/gui/make_blender_root.sh "$(FACIAL_RETARGET_BLENDER_ROOT)"
	$(BIN)/python -m pytest tests/gui $(GUI_TESTS)

# The pictures of the pages in docs, taken by the scenarios that play what the pages say.
pictures:
	FACIAL_RETARGET_PICTURES=build/pictures $(MAKE) gui-test GUI_TESTS="-k 'tutorial or panels'"
	cp build/pictures/*/docs/*.png docs/pictures/

lint: .venv/ready
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy

zip: .venv/ready
	$(BIN)/python build_extension.py --out dist --platforms all

bench: .venv/ready
	$(BIN)/python -m bench

# Newer pins: needs pip-tools for Python 3.11 and 3.13.
COMPILE = -m piptools compile --quiet --generate-hashes --allow-unsafe --strip-extras --no-header --no-annotate \
    --no-emit-index-url --no-emit-trusted-host --no-emit-find-links
pins:
	cd requirements && python3.11 $(COMPILE) develop.in -o develop.txt
	cd requirements && python3.11 $(COMPILE) blender-4.5.in -o blender-4.5.txt
	cd requirements && python3.13 $(COMPILE) blender-5.2.in -o blender-5.2.txt

clean:
	rm -rf build dist .venv .venv-4.5 .venv-5.2
