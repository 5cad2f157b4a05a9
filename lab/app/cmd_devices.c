// cmd_devices.c - `splatlab devices`: the OpenCL devices of this machine, in the order in which --device counts them.
#include "lab/app/commands.h"
#include "lab/base/log.h"
#include "lab/base/mem.h"
#include "lab/gpu/gpu.h"
#include "lab/io/json_io.h"

#include <stdio.h>

typedef struct {
    bool json;
} Options;

static const Options DEFAULTS = {0};
static const OptionField FIELDS[] = {
    {OPTION_JSON_OF(Options, "the list")},
};
static const OptionTable TABLE = {FIELDS, sizeof FIELDS / sizeof FIELDS[0], &DEFAULTS};

static void print_json(const GpuInfo *infos, int count) {
    json_t *list = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(list, json_pack("{si ss* ss* ss* ss si sI sI sb}", "number", i, "name", infos[i].name,
                                              "platform", infos[i].platform, "version", infos[i].version, "type",
                                              infos[i].is_cpu ? "cpu" : "gpu", "compute_units", infos[i].compute_units,
                                              "memory_bytes", (json_int_t)infos[i].memory_bytes, "max_alloc_bytes",
                                              (json_int_t)infos[i].max_alloc_bytes, "fp64", infos[i].has_fp64));
    json_t *root = json_pack("{so}", "devices", list);
    json_print(root);
    json_decref(root);
}

static void print_table(const GpuInfo *infos, int count) {
    for (int i = 0; i < count; i++)
        printf("%d  %s  %s\n   %s, %s; %d compute units, %.1f GiB, fp64 %s\n", i, infos[i].is_cpu ? "CPU" : "GPU",
               infos[i].name, infos[i].platform, infos[i].version, infos[i].compute_units,
               (double)infos[i].memory_bytes / (1 << 30), infos[i].has_fp64 ? "yes" : "no");
}

static int cmd_devices(int argc, char **argv) {
    Options options = DEFAULTS;
    int count, exit_code;
    if (!command_line_parse(&CMD_DEVICES, &TABLE, argc, argv, &options, NULL, 0, &count, &exit_code)) return exit_code;
    GpuInfo *infos = NULL;
    if (!gpu_list(&infos, &count)) return command_failed();
    if (options.json)
        print_json(infos, count);
    else
        print_table(infos, count);
    if (count == 0) log_warn("there is no OpenCL device; on Debian: apt install pocl-opencl-icd runs it on the CPU");
    mem_free(infos);
    return 0;
}

const Command CMD_DEVICES = {
    .name = "devices",
    .arguments = "",
    .summary = "list the OpenCL devices of this machine",
    .details = "Other commands take one by --device: auto (the best GPU, else the CPU), cpu, gpu, a number of this "
               "list, or a part\nof a name.\n\n"
               "  splatlab devices\n"
               "  splatlab train studio -o run --device 1",
    .run = cmd_devices,
};
