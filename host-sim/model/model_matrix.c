/* See model_matrix.h. */
#include "model_matrix.h"

#include <math.h>
#include <string.h>

const double model_matrix_identity[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

void model_matrix_multiply(model_matrix to, const double (*a)[4], const double (*b)[4])
{
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            to[row][column] = column == 3 ? a[row][3] : 0;
            for (int k = 0; k < 3; k++) {
                to[row][column] += a[row][k] * b[k][column];
            }
        }
    }
}

/* The cofactor of an element. */
static double cofactor(const double (*m)[4], int row, int column)
{
    const int a = (row + 1) % 3, b = (row + 2) % 3, c = (column + 1) % 3, d = (column + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
}

double model_matrix_determinant(const double (*m)[4])
{
    return m[0][0] * cofactor(m, 0, 0) + m[0][1] * cofactor(m, 0, 1) + m[0][2] * cofactor(m, 0, 2);
}

bool model_matrix_invert(model_matrix to, const double (*m)[4])
{
    const double determinant = model_matrix_determinant(m);
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            to[row][column] = cofactor(m, column, row) / determinant;
        }
        to[row][3] = -(to[row][0] * m[0][3] + to[row][1] * m[1][3] + to[row][2] * m[2][3]);
    }
    return determinant != 0 && isfinite(to[0][0] + to[1][1] + to[2][2] + to[0][3] + to[1][3] + to[2][3]);
}

void model_matrix_from_columns(model_matrix to, const float *m)
{
    for (int i = 0; i < 12; i++) {
        to[i / 4][i % 4] = m != NULL ? (double)m[4 * (i % 4) + i / 4] : model_matrix_identity[i / 4][i % 4];
    }
}

void model_matrix_compose(model_matrix to, const double t[3], const double q[4], const double s[3])
{
    const double size = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], two = size > 0 ? 2 / size : 0;
    for (int column = 0; column < 3; column++) {
        const int j = (column + 1) % 3, k = (column + 2) % 3;
        to[column][column] = s[column] * (1 - two * (q[j] * q[j] + q[k] * q[k]));
        to[j][column] = s[column] * two * (q[column] * q[j] + q[3] * q[k]);
        to[k][column] = s[column] * two * (q[column] * q[k] - q[3] * q[j]);
        to[column][3] = t[column];
    }
}

double model_matrix_column(const double (*m)[4], int k)
{
    return sqrt(m[0][k] * m[0][k] + m[1][k] * m[1][k] + m[2][k] * m[2][k]);
}
