// difference.h - derivatives by central differences: the referee of every gradient.
#ifndef SPLATLAB_TESTS_SUPPORT_DIFFERENCE_H
#define SPLATLAB_TESTS_SUPPORT_DIFFERENCE_H

// d loss / d *number. Fourth order: the error is of order h^4, so that h can be large enough for rounding not to matter.
// *number comes back as it was.
double difference_central(double *number, double h, double (*loss)(void *context), void *context);

// Fails the test unless each |actual - expected| <= relative * |expected| + floor * (the largest |expected|); the message
// names `what` and the index.
void difference_compare(int count, const double *actual, const double *expected, double relative, double floor,
                        const char *what);

#endif
