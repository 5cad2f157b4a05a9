// command_help.h - what `splatlab COMMAND --help` prints, made from the command and its option table.
#ifndef SPLATLAB_LAB_APP_COMMAND_HELP_H
#define SPLATLAB_LAB_APP_COMMAND_HELP_H

#include "lab/app/command_line.h"

// On stdout: usage, summary, each option with its unit, range and default under its section's heading, then the details.
void command_help(const Command *command, const OptionTable *table);

#endif
