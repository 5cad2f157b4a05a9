# splatlab: one Makefile, no recursion. `make help` lists the targets.
#
#   make MODE=debug|asan    other builds, each in its own build/MODE folder; the program is always ./splatlab for release,
#                           build/MODE/splatlab for the others.

MODE   ?= release
PREFIX ?= /usr/local
BUILD  := build/$(MODE)
PROGRAM := $(if $(filter release,$(MODE)),splatlab,$(BUILD)/splatlab)

CC  ?= gcc
CXX ?= g++
MODE_FLAGS_release := -O2
MODE_FLAGS_debug   := -O0 -g3
MODE_FLAGS_asan    := -O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=undefined
MODE_FLAGS := $(MODE_FLAGS_$(MODE))
$(if $(MODE_FLAGS),,$(error MODE=$(MODE): want release, debug or asan))

# -ffp-contract=off: the compiler never fuses a * b + c on its own, so the C reference gives the same bits everywhere.
WARNINGS := -Wall -Wextra -Werror -Wshadow -Wvla -Wwrite-strings
COMMON   := $(MODE_FLAGS) $(WARNINGS) -ffp-contract=off -pthread -I. -D_GNU_SOURCE -DCL_TARGET_OPENCL_VERSION=120 \
            -DSPLATLAB_INSTALLED_KERNELS='"$(PREFIX)/share/splatlab/kernels"'
CFLAGS   += -std=c17 $(COMMON) -Wstrict-prototypes -Wmissing-prototypes
CXXFLAGS += -std=c++17 $(COMMON)
LDLIBS   += -lOpenImageIO -lOpenImageIO_Util -lOpenCL -ljansson -lpopt -lmd -lz -lstdc++ -lm

SOURCES := $(wildcard lab/base/*.c lab/io/*.c lab/io/*.cpp lab/gpu/*.c splat2d/*.c splat3d/*.c lab/app/*.c)
OBJECTS := $(patsubst %,$(BUILD)/%.o,$(SOURCES))
LIBRARY_OBJECTS := $(filter-out $(BUILD)/lab/app/main.c.o,$(OBJECTS))

# tests/FOLDER/test_NAME.c: one cmocka program each, linked with everything but main; helpers stand in tests/support.
TEST_SOURCES := $(wildcard tests/*/test_*.c)
TEST_SUPPORT := $(patsubst %,$(BUILD)/%.o,$(wildcard tests/support/*.c))
TESTS        := $(patsubst tests/%.c,$(BUILD)/tests/%,$(TEST_SOURCES))

.PHONY: all
all: $(PROGRAM) compile_commands.json

$(PROGRAM): $(OBJECTS)
	$(CC) $(MODE_FLAGS) -pthread -o $@ $^ $(LDLIBS)

$(BUILD)/%.c.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/%.cpp.o: %.cpp
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/tests/%: $(BUILD)/tests/%.c.o $(TEST_SUPPORT) $(LIBRARY_OBJECTS)
	$(CC) $(MODE_FLAGS) -pthread -o $@ $^ -lcmocka -lgsl -lgslcblas $(LDLIBS)

# splat2d stands alone: no OpenCL, no window, no image library. This link proves it.
$(BUILD)/tests/splat2d/%: $(BUILD)/tests/splat2d/%.c.o $(patsubst %,$(BUILD)/%.o,$(wildcard lab/base/*.c splat2d/*.c))
	$(CC) $(MODE_FLAGS) -pthread -o $@ $^ -lcmocka -lgsl -lgslcblas -lm

-include $(shell [ -d build ] && find build -name '*.d')
.SECONDARY:
