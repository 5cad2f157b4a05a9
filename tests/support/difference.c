#include "tests/support/difference.h"

#include "tests/support/support.h"

#include <math.h>

static double loss_at(double *number, double value, double (*loss)(void *context), void *context) {
    *number = value;
    return loss(context);
}

double difference_central(double *number, double h, double (*loss)(void *context), void *context) {
    double value = *number;
    double near = loss_at(number, value + h, loss, context) - loss_at(number, value - h, loss, context);
    double far = loss_at(number, value + 2 * h, loss, context) - loss_at(number, value - 2 * h, loss, context);
    *number = value;
    return (8 * near - far) / (12 * h);
}

void difference_compare(int count, const double *actual, const double *expected, double relative, double floor,
                        const char *what) {
    double largest = 0;
    for (int i = 0; i < count; i++) largest = fmax(largest, fabs(expected[i]));
    for (int i = 0; i < count; i++) {
        char name[256];
        snprintf(name, sizeof name, "%s, number %d", what, i);
        support_near(actual[i], expected[i], relative * fabs(expected[i]) + floor * largest, name);
    }
}
