/*
 * Usage: node motion_file.mjs FILE.gltf SEED [far]
 * Writes a glTF file whose parts move: a skinned tube of 4 joints (rotations in each interpolation, translations, scales
 * that are not 1, four joints a vertex), a tube on a chain of nodes that turn, a tube with two morph targets, and a
 * second skin of 9 joints, which are numbers of 16 bits, with two morph targets and eight joints a vertex.
 * Clips: `all`, `one key`, `none` (no length).
 * far: numbers of any size. The file's unit is .01 to 100, and what all stands in is scaled as much again, and turned;
 * scales reach from 0 to 4 and differ by axis, some change their sign, and targets move a vertex by as much as the mesh is
 * high. Its clip is `all`.
 */
import { writeFileSync } from 'node:fs'

const [path, seedText, kind] = process.argv.slice(2)
const isFar = kind === 'far'
let seed = Number(seedText)
function any(low = -1, high = 1) { // mulberry32
  seed = (seed + 0x6d2b79f5) | 0
  let t = Math.imul(seed ^ (seed >>> 15), 1 | seed)
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t
  return low + ((t ^ (t >>> 14)) >>> 0) / 4294967296 * (high - low)
}
const turn = (most) => {
  const a = [any(), any(), any()], n = Math.hypot(...a), half = any(-most, most) / 2
  return [...a.map((v) => v / n * Math.sin(half)), Math.cos(half)]
}

const unit = isFar ? 10 ** any(-2, 2) : 1
const lengths = (...v) => v.map((x) => x * unit)
/* Scales between two numbers; far: some are 0, some reach to 4, and a node in three is turned inside out. */
const scales = (low, high) => {
  const three = [0, 1, 2].map(() => any(low, high))
  return !isFar ? three : three.map((v) => any() < -.7 ? 0 : any() < 0 ? any(0, 4) : any() < -.4 ? -v : v)
}

const parts = [], accessors = [], bufferViews = []
let bytes = 0
function accessor(numbers, type, width, kind = 5126, target) {
  const array = kind === 5126 ? new Float32Array(numbers) : kind === 5123 ? new Uint16Array(numbers) : new Uint8Array(numbers)
  const data = Buffer.from(array.buffer), count = numbers.length / width
  const column = (i) => Array.from(array).filter((_, k) => k % width === i)
  bufferViews.push({ buffer: 0, byteOffset: bytes, byteLength: data.length, ...(target ? { target } : {}) })
  const limits = type === 'MAT4' ? {} : { min: [...Array(width).keys()].map((i) => Math.min(...column(i))), max: [...Array(width).keys()].map((i) => Math.max(...column(i))) }
  accessors.push({ bufferView: bufferViews.length - 1, componentType: kind, count, type, ...limits })
  const pad = Buffer.alloc((4 - data.length % 4) % 4)
  parts.push(data, pad)
  bytes += data.length + pad.length
  return accessors.length - 1
}

// ---- meshes: rings of 4 vertices, one above the other

const RINGS = 7
/* Eight joints of nine a vertex, whose weights are all different, in any order. */
function eight(attributes) {
  const joints = [], weights = []
  for (let v = 0; v < RINGS * 4; v++) {
    const first = Math.floor(any(0, 9)), own = [...Array(8).keys()].map((k) => 2 ** k + Math.floor(any(0, 2 ** k)))
    own.push(...own.splice(0, Math.floor(any(0, 8))))
    const sum = own.reduce((a, b) => a + b)
    joints.push(own.map((_, k) => (first + k) % 9))
    weights.push(own.map((w) => w / sum))
  }
  for (const set of [0, 1]) {
    const part = (list) => list.flatMap((l) => l.slice(4 * set, 4 * set + 4))
    attributes[`JOINTS_${set}`] = accessor(part(joints), 'VEC4', 4, 5123, 34962)
    attributes[`WEIGHTS_${set}`] = accessor(part(weights), 'VEC4', 4, 5126, 34962)
  }
}
function tube(x, skinned) {
  const positions = [], normals = [], joints = [], weights = [], indices = []
  for (let ring = 0; ring < RINGS; ring++) {
    for (let k = 0; k < 4; k++) {
      const [dx, dz] = [[1, 0], [0, 1], [-1, 0], [0, -1]][k]
      positions.push(...lengths(x + .2 * dx, ring * .5, .2 * dz))
      normals.push(dx, 0, dz)
      const at = ring / 2, low = Math.min(Math.floor(at), 2), share = at - low
      const four = [(1 - share) * 800, share * 800, 100, k === 0 ? 124 : 0].map(Math.round)
      four[2] += 1024 - four.reduce((a, b) => a + b)
      joints.push(...[0, 1, 2, 3].map((i) => (low + i) % 4))
      weights.push(...four.map((w) => w / 1024))
      if (ring > 0) {
        const a = ring * 4 + k, b = ring * 4 + (k + 1) % 4
        indices.push(a - 4, a, b - 4, b - 4, a, b)
      }
    }
  }
  const attributes = { POSITION: accessor(positions, 'VEC3', 3, 5126, 34962), NORMAL: accessor(normals, 'VEC3', 3, 5126, 34962) }
  if (skinned === 4) {
    attributes.JOINTS_0 = accessor(joints, 'VEC4', 4, 5121, 34962)
    attributes.WEIGHTS_0 = accessor(weights, 'VEC4', 4, 5126, 34962)
  }
  if (skinned === 8) eight(attributes)
  return { attributes, indices: accessor(indices, 'SCALAR', 1, 5123, 34963) }
}
const shifts = (most) => accessor([...Array(RINGS * 12)].map(() => any(-most, most)), 'VEC3', 3, 5126, 34962)
const target = () => ({ POSITION: shifts(isFar ? 3 * unit : .3), NORMAL: shifts(.3) })
const meshes = [{ primitives: [tube(0, 4)] }, { primitives: [tube(0, 0)] },
  { primitives: [{ ...tube(0, 0), targets: [target(), target()] }], weights: [.25, -.5] },
  { primitives: [{ ...tube(0, 8), targets: [target(), target()] }], weights: [.125, .5] }]

/* nodes: 0 .. 3 the joints, scaled by 100 and back as exporters do, 4 what is skinned, 5 .. 6 the box, 7 morphs,
 * 8 .. 16 the joints of the second skin, a chain, 17 what follows it and morphs */

const nodes = [
  { name: 'hip', translation: lengths(-1.5, .1, .2), scale: [100, 100, 100], children: [1] },
  { translation: lengths(0, .01, 0), rotation: turn(.4), scale: [1.1, .9, 1], children: [2] },
  { translation: lengths(0, .01, 0), rotation: turn(.4), children: [3] },
  { translation: lengths(0, .01, 0), scale: [.8, .8, .8] },
  { mesh: 0, skin: 0, translation: lengths(7, 7, 7) },
  { translation: lengths(1, 0, 0), rotation: turn(2), children: [6] },
  { mesh: 1, scale: [.5, .7, .6] },
  { mesh: 2, translation: lengths(2, .3, -.2) },
  ...[...Array(9).keys()].map((k) => ({ translation: k === 0 ? lengths(0, -.5, 2) : lengths(0, .35, 0), ...(k < 8 ? { children: [9 + k] } : {}) })),
  { mesh: 3, skin: 1 },
  ...(isFar ? [{ scale: [0, 0, 0].fill(10 ** any(-2, 2)), rotation: turn(3), translation: lengths(any(), any(), any()), children: [0, 4, 5, 7, 8, 17] }] : []),
]
const bind = [0, 1, 2, 3].flatMap((k) => [.01, 0, 0, 0, 0, .01, 0, 0, 0, 0, .01, 0, ...lengths(0, -.01 * k, 0), 1])
const skins = [{ joints: [0, 1, 2, 3], inverseBindMatrices: accessor(bind, 'MAT4', 16), skeleton: 0 },
  { joints: [...Array(9).keys()].map((k) => 8 + k), inverseBindMatrices: accessor([...Array(9).keys()].flatMap((k) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...lengths(0, -.35 * k, 0), 1]), 'MAT4', 16) }]

// ---- clips

const times = (n, length) => accessor([...Array(n).keys()].map((i) => length * (i + .23) / n), 'SCALAR', 1)
function clip(name, n, length) {
  const samplers = [], channels = []
  const add = (node, path, interpolation, value) => {
    if (n < 2 && interpolation === 'CUBICSPLINE') interpolation = 'LINEAR' // it needs two keys
    const parts = interpolation === 'CUBICSPLINE' ? 3 : 1, list = []
    let width = 1
    for (let k = 0; k < n; k++) {
      const keys = value()
      width = path === 'weights' ? 1 : keys.length
      const slope = () => keys.map(() => any(-.3, .3) * (path === 'translation' ? (node < 4 ? .01 : 1) * unit : 1))
      list.push(...(parts === 3 ? [...slope(), ...keys, ...slope()] : keys))
    }
    samplers.push({ input: times(n, length), output: accessor(list, { 1: 'SCALAR', 3: 'VEC3', 4: 'VEC4' }[width], width), interpolation })
    channels.push({ sampler: samplers.length - 1, target: { node, path } })
  }
  add(0, 'rotation', 'LINEAR', () => turn(1))
  add(1, 'rotation', 'CUBICSPLINE', () => turn(1))
  add(2, 'rotation', 'STEP', () => turn(1))
  add(2, 'translation', 'CUBICSPLINE', () => lengths(any(-.002, .002), .01, any(-.002, .002)))
  add(3, 'scale', 'LINEAR', () => scales(.5, 1.1))
  add(5, 'rotation', 'LINEAR', () => turn(3))
  add(6, 'translation', 'LINEAR', () => lengths(any(), any(), any()))
  add(6, 'scale', 'CUBICSPLINE', () => isFar ? scales(.4, .8) : [any(.4, .6), any(.6, .8), any(.5, .7)])
  add(7, 'weights', 'LINEAR', () => [any(), any()])
  for (let k = 8; k < 17; k += 2) add(k, 'rotation', 'LINEAR', () => turn(.5))
  add(10, 'scale', 'LINEAR', () => scales(.7, 1.2))
  add(17, 'weights', 'LINEAR', () => [any(), any()])
  return { name, samplers, channels }
}
const animations = isFar ? [clip('all', 6, 2.5)] : [clip('all', 6, 2.5), clip('one key', 1, 1), clip('none', 1, 0)]

const buffers = [{ byteLength: bytes, uri: `data:application/octet-stream;base64,${Buffer.concat(parts).toString('base64')}` }]
writeFileSync(path, JSON.stringify({ asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: isFar ? [18] : [0, 4, 5, 7, 8, 17] }], nodes, meshes, skins, animations, accessors, bufferViews, buffers }))
