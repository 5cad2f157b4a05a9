// main.c - the program: finds the command by its name and runs it.
#include "lab/app/commands.h"
#include "lab/base/log.h"
#include "lab/base/nearest.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static const char VERSION[] = "0.1.0";

// In the order in which a person meets them.
static const Command *const COMMANDS[] = {&CMD_WIDGET, &CMD_DEMO,   &CMD_EXERCISE, &CMD_FIGURE,
                                          &CMD_FIT2D,  &CMD_SCENE,  &CMD_INFO,     &CMD_TRAIN,
                                          &CMD_EVAL,   &CMD_RENDER, &CMD_BENCH,    &CMD_DEVICES};
enum { COMMAND_COUNT = sizeof COMMANDS / sizeof COMMANDS[0], EXIT_USAGE = 2 };

static int print_help(void) {
    printf("splatlab - a laboratory and trainer for 3D Gaussian splatting\n\n"
           "Usage: splatlab COMMAND [ARGUMENTS] [OPTIONS]\n\n");
    for (int i = 0; i < COMMAND_COUNT; i++) printf("  %-10s %s\n", COMMANDS[i]->name, COMMANDS[i]->summary);
    printf("  %-10s %s\n", "help", "the usage of one command: splatlab help train");
    printf("\nBegin with:\n"
           "  splatlab scene studio -o studio\n"
           "  splatlab train studio -o run\n"
           "  splatlab render run --scene studio --orbit 60 -o orbit.png\n");
    return 0;
}

static const Command *find_command(const char *name) {
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(COMMANDS[i]->name, name) == 0) return COMMANDS[i];
    return NULL;
}

static int unknown_command(const char *name) {
    const char *names[COMMAND_COUNT];
    int best;
    for (int i = 0; i < COMMAND_COUNT; i++) names[i] = COMMANDS[i]->name;
    if (nearest_find(name, names, COMMAND_COUNT, &best, 1))
        log_error("there is no command '%s'; did you mean '%s'?", name, names[best]);
    else
        log_error("there is no command '%s'; splatlab --help lists them", name);
    return EXIT_USAGE;
}

static int help_for(const char *name) {
    const Command *command = find_command(name);
    if (!command) return unknown_command(name);
    char help[] = "--help";
    char *arguments[] = {(char *)command->name, help, NULL};
    return command->run(2, arguments);
}

static int run(int argc, char **argv) {
    if (argc < 2) return print_help();
    const char *name = argv[1];
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0) return print_help();
    if (strcmp(name, "help") == 0) return argc > 2 ? help_for(argv[2]) : print_help();
    if (strcmp(name, "--version") == 0) {
        printf("splatlab %s\n", VERSION);
        return 0;
    }
    const Command *command = find_command(name);
    return command ? command->run(argc - 1, argv + 1) : unknown_command(name);
}

int main(int argc, char **argv) {
    int exit_code = run(argc, argv);
    // A result that could not be written (a full disk behind stdout) is no result.
    if (fflush(stdout) != 0 || ferror(stdout)) {
        log_error("cannot write to standard output: %s", strerror(errno));
        return exit_code ? exit_code : 1;
    }
    return exit_code;
}
