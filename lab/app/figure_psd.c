// figure_psd.c - the cone of valid matrices, a descent that leaves it, and one that cannot (trap_page.h).
#include "lab/app/figure.h"
#include "lab/app/palette.h"
#include "lab/app/trap_page.h"

enum { STEPS = 40 };

static bool draw(GuiRect place, json_t *numbers) {
    static const char *const names[PSD_WAY_COUNT] = {[PSD_RAW] = "raw", [PSD_FACTORED] = "factored"};
    TrapPage *page = trap_page_create();
    trap_page_advance(page, STEPS);
    trap_cone(page, (GuiRect){place.x + 24, place.y + 14, 420, place.height - 20});
    trap_plot(page, (GuiRect){place.x + 470, place.y + 14, 315, place.height - 26});
    for (int way = 0; way < PSD_WAY_COUNT; way++) {
        const PsdWalk *walk = &page->trap.walks[way];
        Eigen2 e = sym2_eigen(psd_walk_covariance(walk));
        int left_at = -1; // the first step outside
        for (int i = 0; i <= walk->step && left_at < 0; i++)
            if (sym2_eigen(walk->path[i]).minor <= 0) left_at = i;
        json_object_set_new(numbers, names[way],
                            json_pack("{si sf sf sf si}", "steps", walk->step, "loss", walk->loss[walk->step],
                                      "eigenvalue_major", e.major, "eigenvalue_minor", e.minor, "left_cone_at",
                                      left_at));
    }
    trap_page_destroy(page);
    return true;
}

const Figure FIGURE_PSD = {"psd", "a descent on raw entries leaves the cone; the factored one cannot", 800, 380, draw};
