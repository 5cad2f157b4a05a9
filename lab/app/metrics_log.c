#include "lab/app/metrics_log.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"

#include <errno.h>
#include <jansson.h>
#include <string.h>

// How many bytes at the start of the old log are whole lines of steps up to steps_done.
static size_t bytes_to_keep(const char *text, int steps_done) {
    size_t kept = 0;
    for (const char *line = text, *end; (end = strchr(line, '\n')); line = end + 1) {
        json_t *object = json_loadb(line, (size_t)(end - line), 0, NULL);
        json_t *step = json_object_get(object, "iteration");
        bool keep = json_is_integer(step) && json_integer_value(step) <= steps_done;
        json_decref(object);
        if (!keep) break;
        kept = (size_t)(end + 1 - text);
    }
    return kept;
}

bool metrics_log_open(const char *path, int steps_done, MetricsLog *log) {
    if (file_exists(path)) {
        char *text;
        size_t size;
        if (!file_read(path, &text, &size)) return false;
        bool done = file_write(path, text, bytes_to_keep(text, steps_done));
        mem_free(text);
        if (!done) return false;
    }
    FILE *file = fopen(path, "a");
    if (!file) return fail("cannot write %s: %s", path, strerror(errno));
    *log = (MetricsLog){.file = file, .path = mem_text(path), .logged_step = steps_done};
    return true;
}

// Writes the object as one line and releases it. Flushed, so that a killed run leaves whole lines.
static bool write_line(MetricsLog *log, json_t *object) {
    int failed = json_dumpf(object, log->file, JSON_COMPACT | JSON_REAL_PRECISION(7));
    json_decref(object);
    if (failed || fputc('\n', log->file) == EOF || fflush(log->file) != 0)
        return fail("cannot write %s: %s; is the disk full?", log->path, strerror(errno));
    return true;
}

static json_t *stage_times(const GpuStageTime *times, int count, int steps) {
    json_t *ms = json_object();
    for (int i = 0; i < count; i++)
        json_object_set_new(ms, times[i].stage, json_real((times[i].device_ms + times[i].host_ms) / steps));
    return ms;
}

bool metrics_log_step(MetricsLog *log, const StepReport *r, double seconds, const GpuStageTime *times, int time_count) {
    json_t *line = json_pack("{si sf sf sf sf si si sI sf}", "iteration", r->step, "loss", r->loss.total, "l1",
                             r->loss.l1, "ssim", r->loss.ssim, "psnr", r->psnr, "splats", r->splats, "visible",
                             r->frame.visible, "pairs", (json_int_t)r->frame.pairs, "seconds", seconds);
    int steps = r->step - log->logged_step;
    json_object_set_new(line, "ms", stage_times(times, time_count, steps > 0 ? steps : 1));
    if (r->density.cloned || r->density.split || r->density.pruned) {
        json_object_set_new(line, "cloned", json_integer(r->density.cloned));
        json_object_set_new(line, "split", json_integer(r->density.split));
        json_object_set_new(line, "pruned", json_integer(r->density.pruned));
    }
    if (r->shrink > 1) json_object_set_new(line, "shrink", json_integer(r->shrink));
    if (r->opacity_reset) json_object_set_new(line, "opacity_reset", json_true());
    log->logged_step = r->step;
    return write_line(log, line);
}

bool metrics_log_evaluation(MetricsLog *log, int step, const Evaluation *e) {
    return write_line(log, json_pack("{si s{sf sf sf}}", "iteration", step, "held_out", "psnr", e->psnr, "ssim",
                                     e->ssim, "psnr8", e->psnr8));
}

void metrics_log_close(MetricsLog *log) {
    if (log->file) fclose(log->file);
    mem_free(log->path);
    *log = (MetricsLog){0};
}
