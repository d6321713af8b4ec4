// lesson_code: the lines of C that make the same camera (camera.h, geom.h).
import { lessonHand } from './lesson_algebra.mjs';
import { readLessonCamera } from './lesson_state.mjs';

const C_CONVENTIONS = { gl: 'PH_GL', d3d: 'PH_D3D', lmu: 'PH_LMU', reversed: 'PH_REVERSED' };

// A number as fixed point, which is rounded as fx_from_text() does: to the nearest, halves away from 0.
function cFixed(text) {
    const number = +text, code = Math.sign(number) * Math.floor(Math.abs(number) * 65536 + 0.5);
    return Number.isInteger(number) ? `FX_INT(${number})` : `${code} /* ${text} */`;
}

const cVector = (texts) => `(struct fx_vec3){${texts.map(cFixed).join(', ')}}`;

// The keys of --camera with their numbers: { eye: ['0', '0', '5'], ... }.
function readCKeys(text) {
    const keys = {};
    let key = '';
    for (const word of text.split(',')) {
        const [, name, number] = /^(?:([a-z]+)=)?(.*)$/.exec(word);
        key = name ?? key;
        (keys[key] ??= []).push(number);
    }
    return keys;
}

function cViewOf(camera) {
    const keys = readCKeys(camera), zero = ['0', '0', '0'], up = ['0', '1', '0'], turns = (keys.ypr ?? []).map((turn) => `fx_turn32_from_deg(${cFixed(turn)})`);
    if (keys.vrp) {
        return `ph_view_phigs(${[keys.vrp, keys.vpn, keys.vup ?? up].map(cVector).join(', ')})`;
    }
    if (keys.ypr) {
        return `ph_view_yaw_pitch_roll(${cVector(keys.eye ?? zero)}, ${turns.join(', ')})`;
    }
    if (keys.quat) {
        return `ph_view_quat(fx_quat_normalise((struct fx_quat){${keys.quat.map(cFixed).join(', ')}}), ${cVector(keys.eye ?? zero)})`;
    }
    return `ph_view_look_at(${[keys.eye, keys.target ?? zero, keys.up ?? up].map(cVector).join(', ')})`;
}

// A fraction times 2^bits as a whole number: exact where it is one.
function cWhole(fraction, bits) {
    const [over, under] = fraction.split('/').map(BigInt);
    return Number((over << BigInt(bits)) / (under ?? 1n));
}

// The view that the lines R and view of pinhole-sim state, in fields: for one that was typed as a matrix.
function cViewFields({ lines, matrices }, convention) {
    const mirrored = convention === 'd3d', left_world = mirrored && lessonHand(matrices.view) > 0;
    const rows = [0, 1, 2].map((i) => [0, 1, 2].map((j) => {
        const code = cWhole(lines[`R.${i}.${j}`][0], 30);
        return (mirrored && i === 2) !== (left_world && j === 2) ? -code : code;
    }));
    const t = [0, 1, 2].map((i) => Math.round(matrices.view[i][3] * 65536) * (mirrored && i === 2 ? -1 : 1));
    return `{.r = {${rows.map((row) => `{${row.join(', ')}}`).join(', ')}}, .t = {${t.join(', ')}}}`;
}

// Near and far plane of a parallel lens, from the factors scale and shift.
function cParallelPlanes(lines, convention) {
    const span = ['d3d', 'reversed'].includes(convention) ? 1 : 2, range = span / Math.abs(lines['scale.2.2'][1]), shift = +lines['shift.2.3'][1];
    const near = convention === 'd3d' ? -shift : convention === 'reversed' ? shift - range : shift - range / 2;
    return [near, near + range].map((distance) => Math.round(distance * 65536));
}

// The lens that the factors of pinhole-sim state, in fields.
function cLensFields({ lines, matrices }, convention) {
    const parallel = lines.w1 === undefined, matrix = matrices.projection, sign = Math.sign(matrix[3][2]) || 1;
    const first = parallel ? 0 : Math.abs(lines['persp.0.0'][2]), [near, far] = parallel ? cParallelPlanes(lines, convention) : [first, Math.abs(lines.w1[2]) - first];
    const scale = (i) => Math.round(cWhole(lines[`scale.${i}.${i}`][0], 36) / 65536 * (parallel ? 1 : near / 65536));
    const shift = (i) => Math.round((parallel ? -matrix[i][3] : -sign * matrix[i][2]) * 65536);
    return { kind: parallel ? 'PH_ORTHOGRAPHIC' : 'PH_PERSPECTIVE', scales: [scale(0), scale(1)], shifts: [shift(0), shift(1)], near, far };
}

// The lines that set `lens`. read: what pinhole-sim printed.
function cLensLines(state, size, read) {
    const near = cFixed(state.get('near') ?? '0.5'), far = cFixed(state.get('far') ?? '100'), planes = `${near.replace('(-', '(')}, ${far.replace('(-', '(')}`;
    const [kind, window] = (state.get('projection') ?? 'perspective').split('='), fit = `ph_projection_fit(&lens, ${size[0]}, ${size[1]});`;
    if (state.has('projection-matrix')) {
        if (!read.lines['scale.0.0']) {
            return ['/* nothing is visible through this matrix */'];
        }
        const { kind: of, scales, shifts, near: n, far: f } = cLensFields(read, state.get('convention'));
        return [`lens = (struct ph_projection){.kind = ${of}, .scale_x_q20 = ${scales[0]}, .scale_y_q20 = ${scales[1]},`,
            `                               .shift_x = ${shifts[0]}, .shift_y = ${shifts[1]}, .near_z = ${n}, .far_z = ${f}};`];
    }
    if (state.has('focal')) {
        const [focal, height] = state.get('focal').split(',');
        return [`ph_projection_pinhole(&lens, ${cFixed(focal.replace('-', ''))}, ${cFixed(height ?? '2')}, ${cFixed(height ?? '2')}, ${planes});`, fit];
    }
    if (kind === 'fisheye') {
        return [`ph_projection_fisheye(&lens, ${cFixed(state.get('fov') ?? '180')}, ${planes});`];
    }
    if (window !== undefined) {
        return [`ph_projection_${kind}(&lens, ${window.split(',').map(cFixed).join(', ')}, ${planes});`];
    }
    if (kind === 'ortho') {
        const camera = readLessonCamera(state.get('camera')), distance = camera === null ? 3 : Math.hypot(...camera.eye.map((x, i) => x - camera.target[i]));
        const top = Math.round(Math.floor(distance * 65536) * Math.tan((state.get('fov') ?? 60) * Math.PI / 360));
        return [`const fx_t top = ${top}; /* what the field of view sees at the target */`, `ph_projection_ortho(&lens, -top, top, -top, top, ${planes});`, fit];
    }
    return [`ph_projection_perspective(&lens, ${cFixed(state.get('fov') ?? '60')}, FX_ONE, ${planes});`, fit];
}

// The lines of C for a state, on a picture of size pixels.
export function lessonCode(state, size, read) {
    const convention = C_CONVENTIONS[state.get('convention') ?? 'gl'], point = (state.get('point') ?? '0,0,0').split(',');
    const view = state.has('camera') ? cViewOf(state.get('camera')) : read.lines['R.0.0'] ? cViewFields(read, state.get('convention')) : 'ph_xform_identity';
    const lines = [`struct ph_xform view = ${view};`, 'struct ph_projection lens;', ...cLensLines(state, size, read)];
    if (state.get('focal')?.startsWith('-') && state.has('camera')) {
        lines.push('const struct ph_xform half_turn = ph_xform_rotate_z(0x80000000u); /* the image is behind the hole */', 'view = ph_xform_mul(&half_turn, &view);');
    }
    lines.push('ph_frame_begin(&renderer, &view, &lens, NULL, 0); /* then ph_draw_mesh(), and the bands */');
    if (!(state.get('projection') ?? '').startsWith('fisheye')) {
        lines.push(`struct ph_mat4 V = ph_matrix_view(&view, ${convention}), P;`, `ph_matrix_projection(&P, &lens, ${convention});`,
            `struct ph_vec4 clip = ph_mat4_apply(&V, (struct ph_vec4){${point.map(cFixed).join(', ')}, FX_ONE}); /* of a vertex in the world */`, 'clip = ph_mat4_apply(&P, clip);');
    }
    return lines.join('\n');
}
