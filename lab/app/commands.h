// commands.h - the commands of the program, one file each (cmd_NAME.c); main.c looks them up here.
#ifndef SPLATLAB_LAB_APP_COMMANDS_H
#define SPLATLAB_LAB_APP_COMMANDS_H

#include "lab/app/command_line.h"

extern const Command CMD_WIDGET, CMD_DEMO, CMD_FIT2D, CMD_SCENE, CMD_INFO, CMD_TRAIN, CMD_EVAL, CMD_RENDER, CMD_BENCH,
    CMD_DEVICES, CMD_EXERCISE, CMD_FIGURE;

#endif
