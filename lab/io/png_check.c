// png_check.c - the chunks of a PNG: length (4 bytes, big-endian), type (4), data, CRC-32 of type and data (4).
// PNG specification, third edition, section 5 (https://www.w3.org/TR/png-3/).
#include "lab/io/png_check.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <stdint.h>
#include <string.h>
#include <zlib.h>

static const char SIGNATURE[8] = "\x89PNG\r\n\x1a\n";
enum { CHUNK_FRAME = 12, HEADER_BYTES = 13 }; // bytes of a chunk besides its data; data bytes of IHDR

static uint32_t big_endian32(const unsigned char *p) {
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

static bool check_chunks(const char *path, const unsigned char *data, size_t size) {
    size_t at = sizeof SIGNATURE;
    for (bool first = true;; first = false) {
        if (size - at < CHUNK_FRAME)
            return fail("cannot read image %s: it ends after %zu bytes without an end mark; is the file complete?",
                        path, size);
        const unsigned char *chunk = data + at;
        size_t length = big_endian32(chunk);
        if (length > size - at - CHUNK_FRAME)
            return fail(
                "cannot read image %s: it ends after %zu bytes in the middle of its data; is the file complete?", path,
                size);
        if (first && (memcmp(chunk + 4, "IHDR", 4) != 0 || length != HEADER_BYTES))
            return fail("cannot read image %s: it has no PNG header; is the file damaged?", path);
        if (crc32(0, chunk + 4, (uInt)length + 4) != big_endian32(chunk + 8 + length))
            return fail("cannot read image %s: wrong check sum at byte %zu; is the file damaged?", path, at);
        if (memcmp(chunk + 4, "IEND", 4) == 0) return true;
        at += CHUNK_FRAME + length;
    }
}

bool png_check(const char *path) {
    char *data;
    size_t size;
    if (!file_read(path, &data, &size)) return false;
    bool is_png = size >= sizeof SIGNATURE && memcmp(data, SIGNATURE, sizeof SIGNATURE) == 0;
    bool ok = !is_png || check_chunks(path, (const unsigned char *)data, size);
    mem_free(data);
    return ok;
}
