/* model_matrix: matrices of 3 x 4 in double precision: three rows, the last column is the translation. */
#ifndef MODEL_MATRIX_H
#define MODEL_MATRIX_H

#include <stdbool.h>

typedef double model_matrix[3][4];

extern const double model_matrix_identity[3][4];

void model_matrix_multiply(model_matrix to, const double (*a)[4], const double (*b)[4]);

/* False: m has no inverse. */
bool model_matrix_invert(model_matrix to, const double (*m)[4]);

/* Makes a matrix of sixteen numbers, column by column, as glTF has them; NULL: the identity. */
void model_matrix_from_columns(model_matrix to, const float *m);

/* Makes a matrix of translation, rotation (x, y, z, w of any length; 0 turns nothing) and scale. */
void model_matrix_compose(model_matrix to, const double t[3], const double q[4], const double s[3]);

/* The length of column k. */
double model_matrix_column(const double (*m)[4], int k);

double model_matrix_determinant(const double (*m)[4]);

#endif
