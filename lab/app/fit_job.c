// fit_job.c - the steps of a fit, and what they leave.
#include "lab/app/fit_job.h"

#include "lab/base/clock.h"
#include "lab/base/fail.h"

static void keep_frame(FitJob *job) {
    if (!job->films || !fit_film_wants(&job->film, fit2d_steps_done(job->fit))) return;
    fit2d_picture(job->fit, &job->picture);
    fit_film_add(&job->film, &job->picture);
}

void fit_job_restart(FitJob *job) {
    fit2d_destroy(job->fit);
    fit_film_destroy(&job->film);
    job->fit = fit2d_create(&job->photo, &job->options);
    job->film = fit_film_begin(job->options.iterations);
    job->loss = (Loss){0};
    job->seconds = 0;
    keep_frame(job);
}

bool fit_job_open(FitJob *job, ImageF photo, const Fit2dOptions *options, const char *folder, bool films) {
    *job = (FitJob){.options = *options, .films = films, .photo = photo};
    if (!fit2d_folder_begin(folder, &job->folder)) return fail_context("fit2d");
    job->picture = imagef_create(photo.width, photo.height, 3);
    fit_job_restart(job);
    return true;
}

void fit_job_close(FitJob *job) {
    fit_film_destroy(&job->film);
    scene2d_destroy(&job->scene);
    fit2d_destroy(job->fit);
    imagef_destroy(&job->picture);
    imagef_destroy(&job->photo);
    fit2d_folder_forget(&job->folder);
    *job = (FitJob){0};
}

void fit_job_step(FitJob *job) {
    double began_s = clock_seconds();
    job->loss = fit2d_step(job->fit);
    job->seconds += clock_seconds() - began_s;
    keep_frame(job);
}

bool fit_job_is_done(const FitJob *job) { return fit2d_steps_done(job->fit) >= job->options.iterations; }

double fit_job_score(FitJob *job) {
    fit2d_picture(job->fit, &job->picture);
    return metric_psnr(&job->picture, &job->photo);
}

bool fit_job_save(FitJob *job) {
    scene2d_destroy(&job->scene);
    job->scene = fit2d_scene(job->fit);
    fit2d_picture(job->fit, &job->picture);
    return fit2d_folder_save(&job->folder, &job->photo, &job->picture, &job->scene) &&
           (!job->films || fit_film_save(&job->film, job->folder.film));
}
