#include "tests/support/session.h"

#include "lab/base/fail.h"
#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "lab/io/json_io.h"
#include "splat2d/scene2d_json.h"
#include "tests/support/support.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static pid_t screen_process, program_process;
static int last_code = -1; // of the program that ended
static char state_path[4096], places_path[4096], script_path[4096];

static void end_screen(void) {
    if (program_process > 0) kill(program_process, SIGKILL);
    if (screen_process > 0) kill(screen_process, SIGTERM);
}

static bool is_installed(const char *program) {
    char command[128];
    snprintf(command, sizeof command, "command -v %s >/dev/null 2>&1", program);
    return system(command) == 0;
}

// Xvfb chooses a free number itself and writes it to the pipe when it is ready.
void session_need_screen(void) {
    if (screen_process > 0) return;
    // The state file is synced to the disk after each change; a busy disk would make the window wait in the midst of a drag.
    if (access("/dev/shm", W_OK) == 0) setenv("TMPDIR", "/dev/shm", 0);
    if (!is_installed("Xvfb") || !is_installed("xdotool")) {
        print_message("skipped: Xvfb or xdotool is not installed (make deps)\n");
        skip();
    }
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    screen_process = fork();
    if (screen_process == 0) {
        char number[16];
        snprintf(number, sizeof number, "%d", ends[1]);
        close(ends[0]);
        if (!freopen("/dev/null", "w", stderr)) _exit(1);
        execlp("Xvfb", "Xvfb", "-displayfd", number, "-screen", "0", "1280x800x24", "-nolisten", "tcp", (char *)NULL);
        _exit(1);
    }
    close(ends[1]);
    char display[16] = ":";
    for (size_t i = 1; i < sizeof display - 1 && !strchr(display, '\n'); i++) // it writes number and newline apart
        if (read(ends[0], display + i, 1) != 1) fail_msg("Xvfb did not start");
    close(ends[0]);
    display[strcspn(display, "\n")] = 0;
    setenv("DISPLAY", display, 1);
    // The OpenGL driver is unloaded before leaks are looked for, so that its own cannot be told apart by name. Demos
    // without a window run the same code without it, and are looked at.
    setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
    atexit(end_screen);
}

static void run_program(const char *program, const char *command, const char *const *arguments) {
    char size[32];
    const char *all[SESSION_ARGUMENTS_MAX + 16] = {program,
                                                   command,
                                                   strcmp(command, "fit2d") == 0 ? "--window-size" : "--size",
                                                   size,
                                                   "--state-file",
                                                   state_path,
                                                   "--places-file",
                                                   places_path};
    snprintf(size, sizeof size, "%dx%d", SESSION_WIDTH, SESSION_HEIGHT);
    for (int i = 0; arguments[i]; i++) all[8 + i] = arguments[i];
    if (chdir(support_scratch()) != 0 || !freopen("program.err", "w", stderr) || !freopen("program.out", "w", stdout))
        _exit(126);
    execv(program, (char *const *)all);
    _exit(127);
}

void session_start(const char *command, ...) {
    const char *arguments[SESSION_ARGUMENTS_MAX + 1] = {NULL};
    va_list values;
    va_start(values, command);
    for (int i = 0; (arguments[i] = va_arg(values, const char *)); i++) assert_true(i < SESSION_ARGUMENTS_MAX);
    va_end(values);
    const char *path = getenv("SPLATLAB");
    char *program = realpath(path ? path : "./splatlab", NULL);
    if (!program) fail_msg("there is no program %s; build it with make, or set SPLATLAB", path ? path : "./splatlab");
    snprintf(state_path, sizeof state_path, "%s/state.json", support_scratch());
    snprintf(places_path, sizeof places_path, "%s/places.json", support_scratch());
    snprintf(script_path, sizeof script_path, "%s/script.xdo", support_scratch());
    unlink(state_path);
    unlink(places_path);
    program_process = fork();
    if (program_process == 0) run_program(program, command, arguments);
    free(program);
    for (int tries = 0; tries < 1500 && !file_exists(places_path); tries++) {
        assert_true(session_is_alive());
        usleep(20000);
    }
    session_do("mousemove 1 1");
}

bool session_is_alive(void) {
    int status;
    if (program_process <= 0) return false;
    if (waitpid(program_process, &status, WNOHANG) == 0) return true;
    program_process = 0;
    last_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return false;
}

int session_wait(void) {
    if (program_process <= 0) return last_code;
    for (int tries = 0; session_is_alive(); tries++) {
        if (tries == 1000) fail_msg("the program does not end");
        usleep(10000);
    }
    return last_code;
}

int session_end(void) {
    if (program_process <= 0) return -1;
    kill(program_process, SIGTERM);
    return session_wait();
}

// How often the window has seen the key that ends each part of a script; -1 before it wrote that down.
static double marks(void) {
    double count = -1;
    json_t *root = NULL;
    if (json_read(places_path, &root)) json_get_number(root, "marks", places_path, &count);
    json_decref(root);
    return count;
}

// The window takes events in order and writes its files at the end of the frame: when it has seen the mark, all before is done.
static void run_part(const char *part, size_t length) {
    double before = marks();
    FILE *script = fopen(script_path, "w");
    assert_non_null(script);
    fprintf(script, "%.*s\nkey F12\n", (int)length, part);
    fclose(script);
    char command[4200];
    snprintf(command, sizeof command, "xdotool '%s'", script_path);
    assert_int_equal(system(command), 0);
    for (int tries = 0; marks() == before; tries++) {
        if (!session_is_alive()) return; // a test may end it by a key; all others find out at once
        if (tries == 6000) fail_msg("the window does not answer to: %.*s", (int)length, part);
        usleep(5000);
    }
}

void session_do(const char *format, ...) {
    char *script;
    va_list values;
    va_start(values, format);
    assert_true(vasprintf(&script, format, values) >= 0);
    va_end(values);
    for (const char *part = script; *part;) {
        size_t length = strcspn(part, ";");
        run_part(part, length);
        part += length + (part[length] == ';');
    }
    free(script);
}

void session_drag(double x0, double y0, double x1, double y1) {
    session_do("mousemove %.0f %.0f; mousedown 1; mousemove %.0f %.0f; mousemove %.0f %.0f; mouseup 1", x0, y0,
               (x0 + x1) / 2, (y0 + y1) / 2, x1, y1);
}

const char *session_bytes(void) {
    static char *kept;
    size_t size;
    mem_free(kept);
    kept = NULL;
    if (!file_read(state_path, &kept, &size)) fail_msg("%s", fail_text());
    return kept;
}

const Scene2d *session_scene(void) {
    static Scene2d kept;
    session_bytes();
    scene2d_destroy(&kept);
    if (!scene2d_load(state_path, &kept)) fail_msg("%s", fail_text());
    return &kept;
}

static void read_numbers(const char *path, const char *name, double *values, int count) {
    json_t *root;
    if (!json_read(path, &root)) fail_msg("%s", fail_text());
    bool good =
        count == 1 ? json_get_number(root, name, path, values) : json_get_numbers(root, name, path, values, count);
    json_decref(root);
    if (!good) fail_msg("%s", fail_text());
}

void session_place(const char *label, double middle[2], double size[2]) {
    double r[4];
    read_numbers(places_path, label, r, 4);
    for (int c = 0; c < 2; c++) {
        middle[c] = r[c] + r[c + 2] / 2;
        size[c] = r[c + 2];
    }
}

bool session_has_place(const char *label) {
    json_t *root;
    if (!json_read(places_path, &root)) fail_msg("%s", fail_text());
    bool found = json_has(root, label);
    json_decref(root);
    return found;
}

double session_number(const char *name) {
    double value;
    read_numbers(places_path, name, &value, 1);
    return value;
}

double session_state(const char *name) {
    double value;
    read_numbers(state_path, name, &value, 1);
    return value;
}

void session_point(const double canvas[2], double window[2]) {
    double middle[2], size[2], zoom = session_number("zoom");
    const double x = canvas[0], y = canvas[1]; // they may stand in the scene that is read anew
    const Scene2d *scene = session_scene();
    session_place("canvas", middle, size);
    window[0] = middle[0] + (x - scene->width / 2.0) * zoom;
    window[1] = middle[1] + (y - scene->height / 2.0) * zoom;
}
