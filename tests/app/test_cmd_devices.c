#include "lab/base/mem.h"
#include "lab/gpu/gpu.h"
#include "tests/support/command.h"
#include "tests/support/support.h"

#include <jansson.h>
#include <string.h>

static void the_list_is_that_of_the_library(void **state) {
    (void)state;
    GpuInfo *infos;
    int count;
    assert_true(gpu_list(&infos, &count));
    CommandResult r = command_run("devices", "--json", NULL);
    command_expect(&r, 0);
    json_t *root = json_loads(r.out, 0, NULL);
    assert_non_null(root);
    json_t *list = json_object_get(root, "devices");
    assert_int_equal(json_array_size(list), count);
    for (int i = 0; i < count; i++) {
        json_t *device = json_array_get(list, (size_t)i);
        assert_int_equal(json_integer_value(json_object_get(device, "number")), i);
        assert_string_equal(json_string_value(json_object_get(device, "name")), infos[i].name);
        assert_string_equal(json_string_value(json_object_get(device, "type")), infos[i].is_cpu ? "cpu" : "gpu");
        assert_true((size_t)json_integer_value(json_object_get(device, "memory_bytes")) == infos[i].memory_bytes);
    }
    r = command_run("devices", NULL);
    command_expect(&r, 0);
    for (int i = 0; i < count; i++) assert_non_null(strstr(r.out, infos[i].name));
    json_decref(root);
    mem_free(infos);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_list_is_that_of_the_library)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
