// scene_folder.h - the folder of a sample scene: made, recognised, and never left looking complete when it is not.
#ifndef SPLATLAB_SPLAT3D_SCENE_FOLDER_H
#define SPLATLAB_SPLAT3D_SCENE_FOLDER_H

#include <stdbool.h>

// Makes the folder with images/ and depth/ in it, and a README.md that says it is unfinished. A sample scene that stands there is
// removed; fails on a folder with anything else in it.
bool scene_folder_begin(const char *folder);

// Removes what sample scenes consist of and no other file; the folder too when that empties it.
void scene_folder_remove(const char *folder);

// Replaces README.md, which makes the scene complete. text: what follows the title.
bool scene_folder_finish(const char *folder, const char *text);

#endif
