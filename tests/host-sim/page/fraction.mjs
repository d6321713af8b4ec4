// Usage: node fraction.mjs
// The exact numbers of the page's lesson: what is read as one, how it is printed, sums and products against pairs of whole
// numbers, and inverses of matrices.
import { Fraction, matrixInverse, matrixOn, matrixTimes, matrixTranspose } from '../../../host-sim/page/lesson/lesson_fraction.mjs';
import { generator } from './exercise_answers.mjs';

const wrong = [];
const same = (what, is, must) => String(is) === String(must) || wrong.push(`${what}: ${is}, not ${must}`);

const typed = {
    '3/4': '3/4', ' 6 / 8 ': '3/4', '-0.75': '-3/4', '.5': '1/2', '5.': '5', '+2': '2', '1.5/2.5': '3/5', '−2': '-2', '–1/3': '-1/3', '0/7': '0', '-0': '0', '00012': '12',
    '': null, '1/0': null, '1/0.0': null, '2 1/2': null, '1 2': null, '1e3': null, '3/-4': null, '--1': null, '.': null, '/2': null, '0x10': null, Infinity: null, '1,5': null, 一: null, [`1${'0'.repeat(60)}`]: null,
};
Object.entries(typed).forEach(([text, must]) => same(`'${text}'`, Fraction.parse(text), must));

const random = generator(3), whole = () => BigInt(Math.floor(random() * 41) - 20);
for (let i = 0; i < 300; i++) {
    const [a, c] = [whole(), whole()], [b, d] = [whole() || 1n, whole() || 1n], one = new Fraction(a, b), other = new Fraction(c, d);
    const is = (what, value, over, under) => (value.over * under === over * value.under && value.under > 0n) || wrong.push(`${a}/${b} ${what} ${c}/${d}: ${value}`);
    is('plus', one.plus(other), a * d + c * b, b * d);
    is('minus', one.minus(other), a * d - c * b, b * d);
    is('times', one.times(other), a * c, b * d);
    same('size', one.size(), String(one).replace('-', ''));
    same('floor', one.floor(), Math.floor(Number(a) / Number(b)));
    same('compare', one.compare(other), Math.sign(Number(a) / Number(b) - Number(c) / Number(d)));
    if (c !== 0n) {
        is('by', one.by(other), a * d, b * c);
    }
    let gcd = 1n;
    for (let k = 2n; k <= 20n; k++) {
        gcd = one.over % k === 0n && one.under % k === 0n && one.over !== 0n ? k : gcd;
    }
    same(`${a}/${b} is reduced`, gcd, 1);
}

const unit = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
for (let i = 0; i < 100; i++) {
    const matrix = unit.map((row) => row.map(() => Number(whole()))), [[a, b, c], [d, e, f], [g, h, k]] = matrix, inverse = matrixInverse(matrix);
    if (a * (e * k - f * h) - b * (d * k - f * g) + c * (d * h - e * g) === 0) {
        same('an inverse', inverse, null);
    } else {
        same('inverse times matrix', matrixTimes(inverse, matrix), unit);
    }
}
same('the inverse of one row twice', matrixInverse([[1, 2], [1, 2]]), null);
same('a swap of rows', matrixInverse([[0, 1], [1, 0]]), [[0, 1], [1, 0]]);
same('transposed', matrixTranspose([[1, 2, 3], [4, 5, 6]]), [[1, 4], [2, 5], [3, 6]]);
same('on a vector', matrixOn([[1, 2], [3, 4]], [5, 6]), [17, 39]);
console.log(wrong.slice(0, 20).join('\n') || 'fractions: done');
process.exit(wrong.length === 0 ? 0 : 1);
