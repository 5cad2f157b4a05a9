// PoCL finds what it compiled before only after its preprocessor has read the program once more, with all of OpenCL's built-in
// functions: half of a second's start. From its binary a program is there in a millisecond. Other drivers keep compiled programs
// by themselves.
//
// One file for each program, options and device. It holds the key, which is all that the binary depends on, and the binary; a
// program whose text has changed, or is another in another kernel folder, writes over it. A file that is cut short or damaged is not
// believed. Nothing is removed: there are few files, and all may be.

#include "lab/gpu/opencl.h"

#include "lab/base/cache_path.h"
#include "lab/base/mem.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct {
    char magic[8];
    uint64_t key_bytes, binary_bytes;
    uint64_t checksum; // of key and binary
} Header;

static const char MAGIC[8] = "SPLATBIN";

// FNV-1a (Fowler, Noll, Vo), 64 bits.
static uint64_t hash(uint64_t h, const void *data, size_t bytes) {
    const unsigned char *p = data;
    for (size_t i = 0; i < bytes; i++) h = (h ^ p[i]) * 0x100000001b3u;
    return h;
}

static const uint64_t HASH_BEGIN = 0xcbf29ce484222325u;

// Made if need be (where it cannot be, files in it cannot be opened); NULL where there is no place for it.
static char *cache_folder(void) {
    char *folder = cache_path("kernels");
    for (char *end = folder; end; *end = '/') {
        end = strchr(end + 1, '/');
        if (!end) break;
        *end = 0;
        mkdir(folder, 0700);
    }
    if (folder) mkdir(folder, 0700);
    return folder;
}

static char *driver_of(const Gpu *gpu) {
    char driver[256] = "", platform[256] = ""; // the platform's version names the compiler
    cl_platform_id id = NULL;
    clGetDeviceInfo(gpu->device, CL_DRIVER_VERSION, sizeof driver - 1, driver, NULL);
    clGetDeviceInfo(gpu->device, CL_DEVICE_PLATFORM, sizeof id, &id, NULL);
    clGetPlatformInfo(id, CL_PLATFORM_VERSION, sizeof platform - 1, platform, NULL);
    return mem_format("%s\n%s\n%s\n%s\n%s", gpu->info.platform, platform, gpu->info.name, gpu->info.version, driver);
}

// Programs of which one asks for the arguments' names are a person's own: they change all the time.
static bool is_kept(const Gpu *gpu, const char *options) {
    return strcmp(gpu->info.platform, "Portable Computing Language") == 0 && !strstr(options, "-cl-kernel-arg-info");
}

// The text without the marks that say where it stood: two installations of the same kernels share what is kept.
static char *without_line_marks(const char *source) {
    static const char MARK[] = "#line ";
    char *text = mem_alloc(strlen(source) + 1, 1), *out = text;
    while (*source) {
        const size_t length = strcspn(source, "\n"), whole = length + (source[length] == '\n');
        if (strncmp(source, MARK, strlen(MARK)) != 0) {
            memcpy(out, source, whole);
            out += whole;
        }
        source += whole;
    }
    *out = 0;
    return text;
}

// Both owned by the caller; *path is NULL where nothing is kept.
static void name_entry(const GpuProgram *program, const char *source, const char *options, char **path, char **key) {
    char *driver = driver_of(program->gpu), *folder = is_kept(program->gpu, options) ? cache_folder() : NULL;
    const uint64_t h = hash(hash(HASH_BEGIN, driver, strlen(driver)), options, strlen(options));
    char *text = without_line_marks(source);
    *key = mem_format("%s\n%s\n%s", driver, options, text);
    mem_free(text);
    *path = folder ? mem_format("%s/%s-%016" PRIx64 ".bin", folder, program->file, h) : NULL;
    mem_free(folder);
    mem_free(driver);
}

static bool read_entry(FILE *file, const char *key, unsigned char **binary, size_t *bytes) {
    Header header;
    const size_t key_bytes = strlen(key);
    struct stat status;
    if (fstat(fileno(file), &status) != 0 || fread(&header, sizeof header, 1, file) != 1) return false;
    if (memcmp(header.magic, MAGIC, sizeof MAGIC) != 0 || header.key_bytes != key_bytes ||
        (uint64_t)status.st_size != sizeof header + header.key_bytes + header.binary_bytes)
        return false;
    *bytes = (size_t)header.binary_bytes;
    char *read_key = mem_alloc(key_bytes, 1);
    *binary = mem_alloc(*bytes, 1);
    const bool good = fread(read_key, 1, key_bytes, file) == key_bytes && fread(*binary, 1, *bytes, file) == *bytes &&
                      memcmp(read_key, key, key_bytes) == 0 &&
                      hash(hash(HASH_BEGIN, key, key_bytes), *binary, *bytes) == header.checksum;
    mem_free(read_key);
    if (!good) mem_free(*binary);
    return good;
}

bool program_cache_load(const GpuProgram *program, const char *source, const char *options, unsigned char **binary,
                        size_t *bytes) {
    char *path, *key;
    name_entry(program, source, options, &path, &key);
    FILE *file = path ? fopen(path, "rb") : NULL;
    const bool good = file && read_entry(file, key, binary, bytes);
    if (file) fclose(file);
    mem_free(path);
    mem_free(key);
    return good;
}

static bool write_entry(FILE *file, const char *key, const unsigned char *binary, size_t bytes) {
    Header header = {.key_bytes = strlen(key), .binary_bytes = bytes};
    memcpy(header.magic, MAGIC, sizeof MAGIC);
    header.checksum = hash(hash(HASH_BEGIN, key, strlen(key)), binary, bytes);
    return fwrite(&header, sizeof header, 1, file) == 1 && fputs(key, file) >= 0 &&
           fwrite(binary, 1, bytes, file) == bytes && fflush(file) == 0 && fsync(fileno(file)) == 0;
}

// Under another name first: a program that starts at the same moment finds the whole file or none.
static void write_file(const char *path, const char *key, const unsigned char *binary, size_t bytes) {
    char *temporary = mem_format("%s.%ld", path, (long)getpid());
    FILE *file = fopen(temporary, "wb");
    if (file) {
        bool good = write_entry(file, key, binary, bytes);
        good = fclose(file) == 0 && good;
        if (!good || rename(temporary, path) != 0) unlink(temporary);
    }
    mem_free(temporary);
}

void program_cache_save(const GpuProgram *program, const char *source, const char *options) {
    char *path, *key;
    size_t bytes = 0;
    name_entry(program, source, options, &path, &key);
    if (path && clGetProgramInfo(program->program, CL_PROGRAM_BINARY_SIZES, sizeof bytes, &bytes, NULL) == CL_SUCCESS &&
        bytes) {
        unsigned char *binary = mem_alloc(bytes, 1);
        if (clGetProgramInfo(program->program, CL_PROGRAM_BINARIES, sizeof binary, &binary, NULL) == CL_SUCCESS)
            write_file(path, key, binary, bytes);
        mem_free(binary);
    }
    mem_free(path);
    mem_free(key);
}
