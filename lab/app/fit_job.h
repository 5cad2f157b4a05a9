// fit_job.h - one `splatlab fit2d`: photograph, fit, film and folder; step by step for a command line or for a window.
//
//     FitJob job = {0};
//     if (fit_job_open(&job, &photo, ...)) while (!fit_job_is_done(&job)) fit_job_step(&job);
//     fit_job_save(&job);
//     fit_job_close(&job);
#ifndef SPLATLAB_LAB_APP_FIT_JOB_H
#define SPLATLAB_LAB_APP_FIT_JOB_H

#include "lab/app/fit2d_folder.h"
#include "lab/app/fit_film.h"
#include "splat2d/fit2d.h"

#include <stdbool.h>

typedef struct {
    Fit2dOptions options;
    bool films; // fit.gif, too
    Fit2dFolder folder;
    ImageF photo, picture; // picture: what the blobs made when it was last asked for
    Fit2d *fit;
    Scene2d scene; // what was saved
    FitFilm film;
    Loss loss;      // before the last step
    double seconds; // of the steps, without what is shown
} FitJob;

// photo: becomes the job's own. False when the folder cannot be made; close it then, too.
bool fit_job_open(FitJob *job, ImageF photo, const Fit2dOptions *options, const char *folder, bool films);
void fit_job_close(FitJob *job); // accepts a half-built or zeroed one

void fit_job_restart(FitJob *job); // as it was when it was opened
void fit_job_step(FitJob *job);    // one step; frames of the film are kept on the way
bool fit_job_is_done(const FitJob *job);

double fit_job_score(FitJob *job); // makes job->picture as it is now; its PSNR in dB

// Writes everything, for what there is now. Makes job->picture and job->scene.
bool fit_job_save(FitJob *job);

#endif
