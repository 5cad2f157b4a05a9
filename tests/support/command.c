#include "tests/support/command.h"

#include "lab/base/mem.h"
#include "lab/io/file.h"
#include "tests/support/support.h"

#include <fcntl.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { ARGUMENTS_MAX = 32 };

static const char *program_path(void) {
    const char *path = getenv("SPLATLAB");
    if (!path) path = "./splatlab";
    if (access(path, X_OK) != 0) fail_msg("there is no program %s; build it with make, or set SPLATLAB", path);
    return path;
}

// Starts it with stdout and stderr in files, and waits for its end.
static int spawn_and_wait(const char *path, char *const *arguments, const char *out, const char *err) {
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, out, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&files, STDERR_FILENO, err, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    pid_t child;
    int error = posix_spawn(&child, path, &files, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&files);
    if (error) fail_msg("cannot start %s: %s", path, strerror(error));
    int status;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

CommandResult command_run(const char *first, ...) {
    static char *old_out, *old_err;
    char *arguments[ARGUMENTS_MAX] = {(char *)program_path()};
    int count = 1;
    va_list more;
    va_start(more, first);
    for (const char *a = first; a && count < ARGUMENTS_MAX - 1; a = va_arg(more, const char *))
        arguments[count++] = (char *)a;
    va_end(more);

    // Not support_path(): its rotating buffers may hold the caller's paths.
    char out[4096], err[4096];
    snprintf(out, sizeof out, "%s/program.out", support_scratch());
    snprintf(err, sizeof err, "%s/program.err", support_scratch());
    CommandResult result = {.exit_code = spawn_and_wait(arguments[0], arguments, out, err)};
    size_t size;
    mem_free(old_out);
    mem_free(old_err);
    assert_true(file_read(out, &result.out, &size) && file_read(err, &result.err, &size));
    old_out = result.out;
    old_err = result.err;
    return result;
}

static void show(const CommandResult *result) {
    print_message("exit code %d\nstdout: %s\nstderr: %s\n", result->exit_code, result->out, result->err);
}

void command_expect(const CommandResult *result, int exit_code) {
    if (result->exit_code == exit_code) return;
    show(result);
    fail_msg("exit code %d, expected %d", result->exit_code, exit_code);
}

void command_expect_error(const CommandResult *result, int exit_code, ...) {
    command_expect(result, exit_code);
    const char *newline = strchr(result->err, '\n');
    bool good = newline && newline[1] == 0 && strncmp(result->err, "splatlab: ", 10) == 0 && result->out[0] == 0;
    if (!good) show(result);
    assert_true(good); // one line on stderr, nothing on stdout
    va_list texts;
    va_start(texts, exit_code);
    for (const char *text; (text = va_arg(texts, const char *));) {
        if (strstr(result->err, text)) continue;
        show(result);
        fail_msg("stderr does not say '%s'", text);
    }
    va_end(texts);
}
