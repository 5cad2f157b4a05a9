// scene_paint.h - painters of the textures of sample scenes: wood, stone, cloth, brick, leaves and the like.
//
// All take a Paint as context. All fit together at their borders unless they say otherwise, and have fine detail everywhere, which
// gives structure from motion something to hold on to.
#ifndef SPLATLAB_SPLAT3D_SCENE_PAINT_H
#define SPLATLAB_SPLAT3D_SCENE_PAINT_H

#include "splat3d/ray_texture.h"

typedef struct {
    uint32_t seed;
    int count;                 // planks, stripes, bricks, tiles across the texture
    Vec3 base, second, accent; // albedos
} Paint;

// A colour as the web writes it, 0xRRGGBB in sRGB, as linear albedo.
Vec3 paint_colour(uint32_t rgb);

// ---- scene_paint_nature.c ----
RayPainter paint_planks;  // `count` planks along u, fibres along u; base and second wood, accent: joints
RayPainter paint_marble;  // for a ball: a stone cut from a block; veins in second and accent
RayPainter paint_granite; // speckled stone
RayPainter paint_grass;   // mown grass and soil seen from above
RayPainter paint_gravel;  // rounded pebbles
RayPainter paint_leaf;    // one leaf, foot at v = 0
RayPainter paint_bark;
RayPainter paint_peel;   // of an orange or apple: u round, v from pole to pole
RayPainter paint_forest; // far trees and meadows
RayPainter paint_water;  // ripples: height only

// ---- scene_paint_made.c ----
RayPainter paint_checker;   // count x count fields with scratches
RayPainter paint_ceramic;   // glazed, blue ornaments round a vase
RayPainter paint_book;      // a printed cover: frame, title bars, emblem
RayPainter paint_pages;     // the edge of a book
RayPainter paint_wallpaper; // a diamond pattern with flowers
RayPainter paint_panel;     // wainscot boards with grooves, painted
RayPainter paint_cloth;     // woven stripes and checks
RayPainter paint_rug;       // one whole rug with borders and a medallion
RayPainter paint_canvas;    // one abstract painting
RayPainter paint_block;     // a toy block's face: frame and a figure

// ---- scene_paint_building.c ----
RayPainter paint_brick;   // `count` courses
RayPainter paint_paving;  // `count` rings of stones along v, each 2 count stones along u
RayPainter paint_cobble;  // irregular stones
RayPainter paint_plaster; // rough wall with stains
RayPainter paint_roof;    // rows of tiles
RayPainter paint_terracotta;
RayPainter paint_facade; // one storey: `count` windows with shutters, second: shutters, accent: frames

#endif
