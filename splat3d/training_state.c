#include "splat3d/training_state.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <string.h>
#include <zlib.h>

// "splatlab checkpoint" and the version of the layout below; a new layout is a new number.
static const char MAGIC[16] = "splatlab ckpt 2";

typedef struct {
    char magic[16];
    int32_t count, sh_degree, steps_done;
    uint32_t next_id;
    uint64_t scene;
    double seconds;
} Header;

TrainingState training_state_from_model(Gaussians model) {
    TrainingState s = {.model = model};
    size_t n = (size_t)model.count;
    s.m = gaussians_create(model.count, model.sh_degree);
    s.v = gaussians_create(model.count, model.sh_degree);
    s.id = mem_alloc(n, sizeof *s.id);
    s.gradient_sum = mem_alloc(n, sizeof *s.gradient_sum);
    s.seen = mem_alloc(n, sizeof *s.seen);
    for (size_t i = 0; i < n; i++) s.id[i] = (uint32_t)i;
    s.next_id = (uint32_t)n;
    return s;
}

void training_state_destroy(TrainingState *s) {
    gaussians_destroy(&s->model);
    gaussians_destroy(&s->m);
    gaussians_destroy(&s->v);
    mem_free(s->id);
    mem_free(s->gradient_sum);
    mem_free(s->seen);
    *s = (TrainingState){0};
}

enum { ARRAYS_MAX = 3 * FIELD_COUNT + 3 };

typedef struct {
    void *data;
    size_t bytes;
} Array;

// The arrays of a state in the order of the file; returns how many.
static int list_arrays(const TrainingState *s, Array arrays[ARRAYS_MAX]) {
    const Gaussians *parts[3] = {&s->model, &s->m, &s->v};
    size_t n = (size_t)s->model.count;
    int count = 0;
    for (int p = 0; p < 3; p++)
        for (int f = 0; f < FIELD_COUNT; f++)
            if (parts[p]->field[f])
                arrays[count++] = (Array){parts[p]->field[f], n * (size_t)GAUSSIAN_FIELDS[f].width * sizeof(float)};
    arrays[count++] = (Array){s->id, n * sizeof *s->id};
    arrays[count++] = (Array){s->gradient_sum, n * sizeof *s->gradient_sum};
    arrays[count++] = (Array){s->seen, n * sizeof *s->seen};
    return count;
}

static void write_part(FileWriter *writer, uLong *crc, const void *data, size_t bytes) {
    fwrite(data, 1, bytes, writer->stream); // errors are noticed in file_commit()
    *crc = crc32_z(*crc, data, bytes);
}

bool training_state_save(const TrainingState *s, const char *path) {
    FileWriter writer;
    if (!file_begin(&writer, path)) return false;
    Header header = {.count = s->model.count,
                     .sh_degree = s->model.sh_degree,
                     .steps_done = s->steps_done,
                     .next_id = s->next_id,
                     .scene = s->scene,
                     .seconds = s->seconds};
    memcpy(header.magic, MAGIC, sizeof MAGIC);
    Array arrays[ARRAYS_MAX];
    int count = list_arrays(s, arrays);
    uLong crc = crc32(0, NULL, 0);
    write_part(&writer, &crc, &header, sizeof header);
    for (int i = 0; i < count; i++) write_part(&writer, &crc, arrays[i].data, arrays[i].bytes);
    uint32_t sum = (uint32_t)crc;
    fwrite(&sum, sizeof sum, 1, writer.stream);
    return file_commit(&writer);
}

static bool check_header(const Header *header, const char *data, size_t size, const char *path) {
    if (size < sizeof *header || memcmp(header->magic, MAGIC, sizeof MAGIC) != 0)
        return fail("%s is no checkpoint of this version of splatlab; train anew, or use the version that wrote it",
                    path);
    if (header->count < 0 || header->sh_degree < 0 || header->sh_degree > SH_DEGREE_MAX)
        return fail("%s is damaged: %d splats of SH degree %d", path, header->count, header->sh_degree);
    size_t floats = 3 * (size_t)gaussians_floats_per_splat(header->sh_degree) + 3;
    size_t want = sizeof *header + (size_t)header->count * floats * sizeof(float) + sizeof(uint32_t);
    if (size != want) return fail("%s is damaged: %zu bytes, want %zu for %d splats", path, size, want, header->count);
    uint32_t sum;
    memcpy(&sum, data + size - sizeof sum, sizeof sum);
    uint32_t actual = (uint32_t)crc32_z(crc32(0, NULL, 0), (const Bytef *)data, size - sizeof sum);
    if (sum != actual)
        return fail("%s is damaged: its CRC-32 is %08x, want %08x; start the run anew", path, actual, sum);
    return true;
}

bool training_state_load(const char *path, TrainingState *state) {
    char *data;
    size_t size;
    if (!file_read(path, &data, &size)) return false;
    Header header = {0};
    memcpy(&header, data, size < sizeof header ? size : sizeof header);
    if (!check_header(&header, data, size, path)) {
        mem_free(data);
        return false;
    }
    *state = training_state_from_model(gaussians_create(header.count, header.sh_degree));
    state->steps_done = header.steps_done;
    state->seconds = header.seconds;
    state->next_id = header.next_id;
    state->scene = header.scene;
    Array arrays[ARRAYS_MAX];
    int count = list_arrays(state, arrays);
    const char *from = data + sizeof header;
    for (int i = 0; i < count; from += arrays[i].bytes, i++)
        if (arrays[i].bytes) memcpy(arrays[i].data, from, arrays[i].bytes);
    mem_free(data);
    return true;
}
