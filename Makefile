# splatlab: one Makefile for everything. `make help` lists the targets.
#
#   make MODE=debug|asan    other builds, each in its own folder build/MODE. The program is ./splatlab for release and
#                           build/MODE/splatlab for the others.
#   make V=1                shows the commands.

MODE   ?= release
PREFIX ?= /usr/local

ifeq ($(MAKELEVEL),0)
MAKEFLAGS += -j$(shell nproc)
endif

# What `make demo` does: about a minute on two cores.
DEMO_SCENE      ?= studio
DEMO_SIZE       ?= 400x300
DEMO_VIEWS      ?= 40
DEMO_ITERATIONS ?= 3000

# Debian packages: to build, to compute (any vendor's OpenCL driver will do beside PoCL), to test.
PACKAGES := gcc g++ make \
            libopenimageio-dev ocl-icd-opencl-dev opencl-headers libjansson-dev libpopt-dev libmd-dev zlib1g-dev \
            libglfw3-dev libgl-dev libimgui-dev fonts-dejavu-core \
            pocl-opencl-icd \
            libcmocka-dev libgsl-dev openimageio-tools oclgrind clang-format python3 xvfb xauth xdotool libgl1-mesa-dri
# For `make docs` alone.
DOCS_PACKAGES := mkdocs mkdocs-material python3-pymdownx libjs-katex

# ---- the build ----
BUILD   := build/$(MODE)
PROGRAM := $(if $(filter release,$(MODE)),./splatlab,$(BUILD)/splatlab)

MODE_FLAGS_release := -O2
MODE_FLAGS_debug   := -O0 -g3
MODE_FLAGS_asan    := -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined \
                      -Wno-format-truncation # sanitized code hides ranges from this warning; the release build has it
MODE_FLAGS := $(MODE_FLAGS_$(MODE))
$(if $(MODE_FLAGS),,$(error MODE=$(MODE): want release, debug or asan))

# -ffp-contract=off: the compiler never fuses a * b + c on its own, so the C reference gives the same bits everywhere.
# CFLAGS and CXXFLAGS are left to the person who builds; they come last.
CC        ?= gcc
CXX       ?= g++
WARNINGS  := -Wall -Wextra -Werror -Wshadow -Wvla -Wwrite-strings
COMMON    := $(MODE_FLAGS) $(WARNINGS) -ffp-contract=off -pthread -I. -D_GNU_SOURCE -DCL_TARGET_OPENCL_VERSION=120 \
             -DSPLATLAB_INSTALLED_KERNELS='"$(PREFIX)/share/splatlab/kernels"'
C_FLAGS   := -std=c17 $(COMMON) -Wstrict-prototypes -Wmissing-prototypes $(CFLAGS)
CXX_FLAGS := -std=c++17 $(COMMON) -isystem /usr/include/imgui $(CXXFLAGS)
LINK       = $(SAY) "LINK $@"; $(CC) $(MODE_FLAGS) -pthread -Wl,--as-needed $(LDFLAGS) -o $@ $^
SAY       := @$(if $(V),set -x;) echo
LIBRARIES := -lOpenImageIO -lOpenImageIO_Util -lOpenCL -ljansson -lpopt -lmd -lz \
             -limgui -lstb -lglfw -lGL -lstdc++ -lm
TEST_LIBRARIES := -lcmocka -lgsl -lgslcblas

# exercises/01_cov2/ .c -> exercises/01_cov2/cov2.c
exercise_file = $(1)$(shell basename $(1) | sed 's/^[0-9]*_//')$(2)
objects_of = $(patsubst %,$(BUILD)/%.o,$(1))

# The workers run what students write: small programs of their own, one for C and one for kernels, never with a sanitizer, which
# their limits would not bear.
WORKER_PARTS          := $(patsubst %,exercises/harness/worker_%.c,channel guard number)
WORKER_SOURCES        := exercises/harness/worker.c exercises/harness/worker_fence.c $(WORKER_PARTS)
KERNEL_WORKER_SOURCES := $(patsubst %,exercises/harness/%.c,kernel_worker kernel_scan oclgrind_report) $(WORKER_PARTS)
WORKER                := $(BUILD)/splatlab-worker
KERNEL_WORKER         := $(BUILD)/splatlab-kernel-worker

SOURCES := $(wildcard lab/base/*.c lab/io/*.c lab/io/*.cpp lab/gpu/*.c splat2d/*.c splat3d/*.c \
           exercises/*/check.c lab/app/*.c lab/app/*.cpp) $(filter-out $(WORKER_SOURCES) exercises/harness/kernel_worker.c,$(wildcard exercises/harness/*.c))
OBJECTS := $(call objects_of,$(SOURCES))

# tests/FOLDER/test_NAME.c: one cmocka program each; helpers stand in tests/support.
TEST_SOURCES    := $(wildcard tests/*/test_*.c)
TESTS           := $(patsubst %.c,$(BUILD)/%,$(TEST_SOURCES))
SUPPORT_SOURCES := $(wildcard tests/support/*.c)
KERNELS_COMPILE := $(BUILD)/tests/lint/kernels_compile

ALL_SOURCES := $(sort $(SOURCES) $(WORKER_SOURCES) $(KERNEL_WORKER_SOURCES)) $(TEST_SOURCES) $(SUPPORT_SOURCES) tests/lint/kernels_compile.c
ALL_OBJECTS := $(call objects_of,$(ALL_SOURCES))

.PHONY: all
all: $(PROGRAM) $(WORKER) $(KERNEL_WORKER) compile_commands.json ## build ./splatlab

$(PROGRAM): $(OBJECTS)
	$(LINK) $(LIBRARIES)

WORKER_OBJECTS := $(call objects_of,$(WORKER_SOURCES))
$(WORKER_OBJECTS): OBJECT_FLAGS := -fno-sanitize=all
$(WORKER): $(WORKER_OBJECTS)
	$(SAY) "LINK $@"; $(CC) -rdynamic -o $@ $^ -lm

# lab/gpu and lab/base once more, without a sanitizer.
KERNEL_WORKER_OBJECTS := $(patsubst %,$(BUILD)/plain/%.o,$(KERNEL_WORKER_SOURCES) $(wildcard lab/gpu/*.c lab/base/*.c))
$(BUILD)/plain/%.c.o: OBJECT_FLAGS := -fno-sanitize=all
$(BUILD)/plain/%.c.o: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(SAY) "CC   $<"; $(CC) $(C_FLAGS) $(OBJECT_FLAGS) -MMD -MP -c -o $@ $<
$(KERNEL_WORKER): $(KERNEL_WORKER_OBJECTS)
	$(SAY) "LINK $@"; $(CC) -pthread -o $@ $^ -lOpenCL -lm
-include $(KERNEL_WORKER_OBJECTS:.o=.d)

# A person's files, laid out from the stubs; never overwritten.
EXERCISE_FILES := $(foreach stub,$(wildcard exercises/*/stub.c exercises/*/stub.cl),\
                    $(call exercise_file,$(dir $(stub)),$(suffix $(stub))))
all: $(EXERCISE_FILES)
$(EXERCISE_FILES):
	@cp -n $(@D)/stub$(suffix $@) $@

$(BUILD)/%.c.o: %.c $(BUILD)/flags
	@mkdir -p $(@D)
	$(SAY) "CC   $<"; $(CC) $(C_FLAGS) $(OBJECT_FLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/%.cpp.o: %.cpp $(BUILD)/flags
	@mkdir -p $(@D)
	$(SAY) "CXX  $<"; $(CXX) $(CXX_FLAGS) -MMD -MP -c -o $@ $<

# One archive a folder, so that a test takes from it only what it needs.
define archive_of
$(BUILD)/$(1).a: $(call objects_of,$(wildcard $(1)/*.c $(1)/*.cpp))
	@rm -f $$@; $(AR) rcs $$@ $$^
endef
$(BUILD)/exercises.a: $(call objects_of,$(filter exercises/%,$(SOURCES)))
	@rm -f $@; $(AR) rcs $@ $^
$(foreach folder,lab/base lab/io lab/gpu splat2d splat3d lab/app tests/support,$(eval $(call archive_of,$(folder))))

# The tests of a floor are linked with that floor and what it may use, highest first; this proves that it uses no more.
# $(1) folder of tests/, $(2) folders, $(3) libraries.
define tests_of
$(BUILD)/tests/$(1)/%: $(BUILD)/tests/$(1)/%.c.o $(patsubst %,$(BUILD)/%.a,tests/support $(2))
	$$(LINK) $(3) -lm
endef
$(eval $(call tests_of,base,lab/base,$(TEST_LIBRARIES)))
$(eval $(call tests_of,io,lab/io lab/base,$(TEST_LIBRARIES) $(LIBRARIES)))
$(eval $(call tests_of,gpu,lab/gpu lab/base,$(TEST_LIBRARIES) -lOpenCL))
# Of lab/io only JSON files: a picture or a device drawn in by splat2d would lack its library here.
$(eval $(call tests_of,splat2d,splat2d lab/io lab/base,$(TEST_LIBRARIES) -ljansson -lmd))
$(eval $(call tests_of,splat3d,splat3d splat2d lab/gpu lab/io lab/base,$(TEST_LIBRARIES) $(LIBRARIES)))
$(eval $(call tests_of,exercises,exercises splat3d splat2d lab/gpu lab/io lab/base,$(TEST_LIBRARIES) $(LIBRARIES)))
$(eval $(call tests_of,app,lab/app exercises splat3d splat2d lab/gpu lab/io lab/base,$(TEST_LIBRARIES) $(LIBRARIES)))
$(eval $(call tests_of,lint,lab/gpu lab/io lab/base,$(LIBRARIES)))

# Other flags (or another PREFIX) than last time: everything is built anew.
$(BUILD)/flags: export FLAGS := $(CC) $(C_FLAGS) / $(CXX) $(CXX_FLAGS)
$(BUILD)/flags: always
	@mkdir -p $(@D)
	@echo "$$FLAGS" | cmp -s - $@ || echo "$$FLAGS" >$@
.PHONY: always

# For editors: how each file is compiled.
EXERCISE_CODE := $(sort $(wildcard exercises/*/stub.c exercises/*/check_calls.c exercises/*/mutants/*.c \
                 exercises/solutions/*.c) $(filter %.c,$(EXERCISE_FILES)))
EXERCISE_FLAGS := -std=c17 -Wall -Wextra -D_GNU_SOURCE -DREAL=double -I.
command_for = $(if $(filter %.cpp,$(1)),$(CXX) $(CXX_FLAGS),$(CC) $(if $(filter $(1),$(EXERCISE_CODE)),\
              $(EXERCISE_FLAGS),$(C_FLAGS))) -c $(1)
compile_commands.json: Makefile $(ALL_SOURCES) $(EXERCISE_CODE)
	@$(file >$@.tmp-make)$(foreach source,$(ALL_SOURCES) $(EXERCISE_CODE),$(file >>$@.tmp-make,{"directory": "$(CURDIR)",\
	    "file": "$(source)", "command": "$(subst ",\",$(call command_for,$(source)))"}))
	@{ echo '['; sed '$$!s/$$/,/' $@.tmp-make; echo ']'; } >$@ && rm $@.tmp-make

-include $(ALL_OBJECTS:.o=.d)
.SECONDARY:

# ---- what stands before it ----
define INSTALL_PACKAGES
missing=
for p in $(WANTED); do
    dpkg-query -W -f='$${db:Status-Status} ' $$p 2>/dev/null | grep -qw installed || missing="$$missing $$p"
done
[ -n "$$missing" ] || exit 0
if ! command -v apt-get >/dev/null; then
    echo "deps: there is no apt-get here. Please install what these Debian packages hold:$$missing" >&2
    exit 1
fi
sudo=
if [ "$$(id -u)" != 0 ]; then
    sudo=sudo
    if ! command -v sudo >/dev/null; then
        echo "deps: please run as root: apt-get install$$missing" >&2
        exit 1
    fi
fi
echo "deps: installing$$missing"
$$sudo apt-get update -q && $$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $$missing
endef
export INSTALL_PACKAGES

.PHONY: deps deps-docs
deps: WANTED := $(PACKAGES)
deps-docs: WANTED := $(DOCS_PACKAGES)
deps: ## install the Debian packages that are missing
	@sh -c "$$INSTALL_PACKAGES"

deps-docs: ## the same for `make docs`
	@sh -c "$$INSTALL_PACKAGES"

# `make deps all`, `make demo` and `make widget` compile nothing before the packages are there.
ifneq ($(filter deps demo widget,$(MAKECMDGOALS)),)
$(ALL_OBJECTS): | deps
endif

# ---- to look at ----
DEMO_DATA := demo/$(DEMO_SCENE)-$(DEMO_SIZE)-$(DEMO_VIEWS)

.PHONY: demo
demo: deps all ## make a sample scene, train on it, show the result
	@[ -e $(DEMO_DATA)/transforms.json ] || \
	    $(PROGRAM) scene $(DEMO_SCENE) -o $(DEMO_DATA) --size $(DEMO_SIZE) --views $(DEMO_VIEWS)
	@rm -rf demo/run
	$(PROGRAM) train $(DEMO_DATA) -o demo/run --iterations $(DEMO_ITERATIONS)
	@$(PROGRAM) eval demo/run --contact-sheet demo/contact_sheet.png >demo/report.txt && cat demo/report.txt
	@echo "Photo, render and error of held-out views: $(CURDIR)/demo/contact_sheet.png"
	@[ -z "$$DISPLAY$$WAYLAND_DISPLAY" ] || ! command -v xdg-open >/dev/null || xdg-open demo/contact_sheet.png 2>/dev/null || \
	    echo "There is no program here that shows pictures: open demo/contact_sheet.png elsewhere"

.PHONY: figures
figures: all ## draw the pictures of the lesson pages in docs/ again
	SPLATLAB=$(PROGRAM) docs/figures/draw docs/images

.PHONY: docs
docs: deps-docs ## make a site of docs/ that needs no network: build/site/index.html
	mkdocs build --quiet --clean
	@echo "Open $(CURDIR)/build/site/index.html"

.PHONY: bench
bench: all ## measure the speed of each stage, and how it grows with the work
	$(PROGRAM) bench
	$(PROGRAM) bench --scaling --rounds 5

.PHONY: widget
widget: deps all ## open the 2-D lesson in a window
	$(PROGRAM) widget

# ---- to check ----
# PoCL and LLVM keep some memory until the program ends; tests/long/leaks.txt names them, all else must be freed.
ifeq ($(MODE),asan)
export LSAN_OPTIONS := suppressions=tests/long/leaks.txt:print_suppressions=0
export UBSAN_OPTIONS := print_stacktrace=1
endif

.PHONY: test
test: all $(TESTS) $(KERNELS_COMPILE) ## run every test (minutes)
	@BUILD=$(BUILD) SPLATLAB=$(PROGRAM) SPLATLAB_WORKERS=$(BUILD) tests/run $(TESTS) tests/lint/selftest.py tests/lint/pages.py

GOLDEN_TESTS := $(BUILD)/tests/app/test_cmd_demo $(BUILD)/tests/app/test_widget

.PHONY: golden
golden: all $(GOLDEN_TESTS) ## take the demos' pictures as they are now for the good ones: look at them first
	@for test in $(GOLDEN_TESTS); do SPLATLAB_GOLDEN=write SPLATLAB=$(PROGRAM) $$test >/dev/null || exit 1; done
	@git status --short tests/golden

.PHONY: test-long
test-long: all ## what takes longer: Oclgrind, resume, thread count, then all tests under ASan and UBSan
	@SPLATLAB=$(PROGRAM) tests/run -t 1200 $(wildcard tests/long/check_*)
	@$(MAKE) --no-print-directory MODE=asan test

.PHONY: lint
lint: $(KERNELS_COMPILE) ## check the house rules: floors, sizes, names, format; kernels compile
	@status=0; python3 tests/lint/lint.py || status=1; $(KERNELS_COMPILE) || status=1; exit $$status

FORMATTED := $(filter-out $(EXERCISE_FILES),$(wildcard $(foreach folder,kernels lab/* splat2d splat3d \
                 exercises exercises/* exercises/*/mutants tests/* tests/exercises/*,\
                 $(folder)/*.c $(folder)/*.h $(folder)/*.cpp $(folder)/*.cl)))

.PHONY: format
format: ## bring all code into the form of .clang-format
	clang-format -i $(FORMATTED)

# ---- to use elsewhere ----
# All of the exercises but what a person wrote there, and what is part of the program.
EXERCISE_INSTALLED := $(wildcard exercises/*.* exercises/*/README.md exercises/*/hints.md exercises/*/stub.* \
                      exercises/*/check_calls.c exercises/*/mutants/* exercises/solutions/*)
EXERCISE_INSTALLED := $(filter-out exercises/progress.json exercises/instructor.sha256,$(EXERCISE_INSTALLED))

.PHONY: install
install: all ## install under PREFIX (/usr/local); DESTDIR is honoured
	install -D -m 755 $(PROGRAM) $(DESTDIR)$(PREFIX)/bin/splatlab
	install -d $(DESTDIR)$(PREFIX)/share/splatlab/kernels
	install -m 644 $(wildcard kernels/*) $(DESTDIR)$(PREFIX)/share/splatlab/kernels
	install -d $(DESTDIR)$(PREFIX)/share/splatlab/demos
	install -m 644 $(wildcard lab/app/demos/*) $(DESTDIR)$(PREFIX)/share/splatlab/demos
	install -d $(DESTDIR)$(PREFIX)/libexec/splatlab
	install -m 755 $(WORKER) $(KERNEL_WORKER) $(DESTDIR)$(PREFIX)/libexec/splatlab
	@set -e; for file in $(EXERCISE_INSTALLED); do \
	    install -D -m 644 $$file $(DESTDIR)$(PREFIX)/share/splatlab/$$file; done
	install -D -m 644 LICENSE $(DESTDIR)$(PREFIX)/share/doc/splatlab/LICENSE

.PHONY: uninstall
uninstall: ## remove what install put there
	rm -rf $(DESTDIR)$(PREFIX)/bin/splatlab $(DESTDIR)$(PREFIX)/libexec/splatlab $(DESTDIR)$(PREFIX)/share/splatlab \
	    $(DESTDIR)$(PREFIX)/share/doc/splatlab

.PHONY: clean
clean: ## remove everything that was built, and the demo; what you wrote in the exercises stays
	rm -rf build splatlab compile_commands.json demo

.PHONY: help
help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## /{printf "make %-10s %s\n", $$1, $$2}' Makefile
	@echo "MODE=release|debug|asan chooses the build; PREFIX=$(PREFIX) where install puts it."
