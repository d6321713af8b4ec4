// lesson_fraction: exact numbers. A Fraction is reduced, its numerator and denominator are BigInts, and its denominator is
// more than 0. Where a Fraction is expected a whole number (Number or BigInt) may stand, too. Matrices are arrays of rows.

const LONGEST = 60; // letters of one number that is typed

export class Fraction {
    constructor(over, under = 1n) {
        if (under === 0n) {
            throw new RangeError('a fraction over 0');
        }
        let a = over < 0n ? -over : over, b = under < 0n ? -under : under;
        while (b > 0n) {
            [a, b] = [b, a % b];
        }
        a = under < 0n ? -a : a; // the greatest common divisor, with the sign of the denominator
        this.over = over / a;
        this.under = under / a;
    }

    // A number that a program states. Text must be one that parse takes; a Number must be whole.
    static of(value) {
        return value instanceof Fraction ? value : typeof value === 'string' ? Fraction.parse(value) : new Fraction(BigInt(value));
    }

    // Reads what a person types: 3/4, -0.75, .5, 1.5/2, also a minus sign that is no hyphen. null: it is no number.
    static parse(text) {
        const [, sign, over, under] = /^([+-]?)(\d+\.?\d*|\.\d+)(?:\/(\d+\.?\d*|\.\d+))?$/.exec(text.trim().replace(/[−–]/g, '-').replace(/\s*\/\s*/g, '/')) ?? [];
        if (over === undefined || text.length > LONGEST) {
            return null;
        }
        const read = (digits) => new Fraction(BigInt(digits.replace('.', '')), digits.includes('.') ? 10n ** BigInt(digits.split('.')[1].length) : 1n);
        const below = read(under ?? '1');
        return below.over === 0n ? null : read(over).by(below).times(sign === '-' ? -1 : 1);
    }

    plus(value) {
        const { over, under } = Fraction.of(value);
        return new Fraction(this.over * under + over * this.under, this.under * under);
    }

    minus(value) {
        return this.plus(Fraction.of(value).negative());
    }

    times(value) {
        const { over, under } = Fraction.of(value);
        return new Fraction(this.over * over, this.under * under);
    }

    // The quotient; value is not 0.
    by(value) {
        const { over, under } = Fraction.of(value);
        return new Fraction(this.over * under, this.under * over);
    }

    negative() {
        return new Fraction(-this.over, this.under);
    }

    size() {
        return this.over < 0n ? this.negative() : this;
    }

    // Less than 0, 0 or more than 0, as this is less than, equal to or more than value.
    compare(value) {
        const { over, under } = Fraction.of(value), difference = this.over * under - over * this.under;
        return difference < 0n ? -1 : difference > 0n ? 1 : 0;
    }

    equals(value) {
        return this.compare(value) === 0;
    }

    // The largest whole number that is not above it.
    floor() {
        const down = this.over / this.under;
        return new Fraction(this.over < 0n && down * this.under !== this.over ? down - 1n : down);
    }

    toString() {
        return this.under === 1n ? `${this.over}` : `${this.over}/${this.under}`;
    }
}

export function fractionOf(value) {
    return Fraction.of(value);
}

export const fractionsOf = (values) => values.map(Fraction.of);

export const matrixTranspose = (matrix) => matrix[0].map((_, j) => matrix.map((row) => row[j]));

// The product of two matrices whose sizes fit; a vector is a matrix of one column.
export function matrixTimes(left, right) {
    const columns = matrixTranspose(right);
    return left.map((row) => columns.map((column) => row.reduce((sum, value, i) => sum.plus(Fraction.of(value).times(column[i])), Fraction.of(0))));
}

// The product with a vector, as an array.
export const matrixOn = (matrix, vector) => matrixTimes(matrix, vector.map((value) => [value])).flat();

// The inverse of a square matrix by Gauss and Jordan. null: it has none.
export function matrixInverse(matrix) {
    const size = matrix.length;
    const rows = matrix.map((row, i) => [...fractionsOf(row), ...fractionsOf(row.map((_, j) => (i === j ? 1 : 0)))]);
    for (let i = 0; i < size; i++) {
        const found = rows.findIndex((row, j) => j >= i && row[i].over !== 0n);
        if (found < 0) {
            return null;
        }
        [rows[i], rows[found]] = [rows[found], rows[i]];
        rows[i] = rows[i].map((value) => value.by(rows[i][i]));
        for (let j = 0; j < size; j++) {
            if (j !== i) {
                rows[j] = rows[j].map((value, k) => value.minus(rows[j][i].times(rows[i][k])));
            }
        }
    }
    return rows.map((row) => row.slice(size));
}
