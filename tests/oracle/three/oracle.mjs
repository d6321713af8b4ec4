/*
 * Usage: node oracle.mjs NODE_MODULES CAMERA_DUMP
 * three.js against the firmware's cameras: seeded random cases, the same integers for both; CAMERA_DUMP (the program of
 * tests/oracle/three/camera_dump.c) prints the firmware's matrices. TAP on standard output, with the largest difference reached in
 * LSB of Q16.16 (2^-16). Exits 1 when a difference is above 2 LSB.
 */
import { spawnSync } from 'node:child_process'
import { pathToFileURL } from 'node:url'

const [modules, dump] = process.argv.slice(2)
const THREE = await import(pathToFileURL(`${modules}/three/build/three.module.js`))

const CASES = 1000
const ALLOWED = 2

// ---- random numbers: mulberry32

let seed = 20

function uniform(low, high) {
  seed = (seed + 0x6d2b79f5) | 0
  let t = Math.imul(seed ^ (seed >>> 15), 1 | seed)
  t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t
  return low + ((t ^ (t >>> 14)) >>> 0) / 4294967296 * (high - low)
}

const logarithmic = (low, high) => Math.exp(uniform(Math.log(low), Math.log(high)))
const fixed = (v) => Math.round(v * 65536)
const real = (raw) => raw / 65536
const radians = (turn32) => turn32 / 4294967296 * 2 * Math.PI
const randomVector = (reach) => [0, 1, 2].map(() => fixed(uniform(-reach, reach)))
const vector = (raw) => new THREE.Vector3(...raw.map(real))
const randomTurn = () => Math.floor(uniform(0, 4294967296))
const quaternion = (axis, turn) => new THREE.Quaternion().setFromAxisAngle(vector(axis).normalize(), radians(turn))

function randomAxis() {
  const v = randomVector(100)
  return vector(v).length() > 10 ? v : randomAxis()
}

/* Place, target and up of a camera, well apart and not in line. */
function randomLook(reach) {
  const place = randomVector(reach), target = randomVector(reach), up = randomVector(1)
  const along = vector(target).sub(vector(place)), length = along.length()
  const across = along.cross(vector(up)).length() / length
  return length > 1 && across > .2 ? { place, target, up } : randomLook(reach)
}

// ---- cases: the line for camera_dump, and three.js's matrix

function perspective() {
  const raw = [fixed(uniform(5, 170)), fixed(logarithmic(.25, 4)), fixed(logarithmic(.05, 10)), 0]
  raw[3] = fixed(real(raw[2]) * logarithmic(1.1, 1000))
  return { raw, matrix: new THREE.PerspectiveCamera(...raw.map(real)).projectionMatrix }
}

function randomBox() {
  const [left, bottom] = [fixed(uniform(-20, 20)), fixed(uniform(-20, 20))]
  const raw = [left, left + fixed(uniform(1, 20)), bottom, bottom + fixed(uniform(1, 20)), fixed(logarithmic(.5, 10)), 0]
  raw[5] = fixed(real(raw[4]) * logarithmic(1.1, 1000))
  return raw
}

function frustum() {
  const raw = randomBox(), [l, r, b, t, n, f] = raw.map(real)
  return { raw, matrix: new THREE.Matrix4().makePerspective(l, r, t, b, n, f) }
}

function ortho() {
  const raw = randomBox(), [l, r, b, t, n, f] = raw.map(real)
  return { raw, matrix: new THREE.OrthographicCamera(l, r, t, b, n, f).projectionMatrix }
}

function turned(object, look) {
  object.position.copy(vector(look.place))
  object.up.copy(vector(look.up))
  object.lookAt(vector(look.target))
  object.updateMatrixWorld()
  return object
}

function camera() {
  const look = randomLook(100)
  const matrix = turned(new THREE.PerspectiveCamera(), look).matrixWorldInverse
  return { raw: [...look.place, ...look.target, ...look.up], matrix }
}

function object() {
  const look = randomLook(100)
  return { raw: [...look.place, ...look.target, ...look.up], matrix: turned(new THREE.Object3D(), look).matrixWorld }
}

function rotation() {
  const axis = randomAxis(), turn = randomTurn()
  return { raw: [...axis, turn], matrix: new THREE.Matrix4().makeRotationFromQuaternion(quaternion(axis, turn)) }
}

function product() {
  const raw = [...randomAxis(), randomTurn(), ...randomAxis(), randomTurn()]
  const q = quaternion(raw.slice(0, 3), raw[3]).multiply(quaternion(raw.slice(4, 7), raw[7]))
  return { raw, matrix: new THREE.Matrix4().makeRotationFromQuaternion(q) }
}

/* A chain of 1 .. 4 nodes, `last` in the end of it. Each rounds its place in the world by up to half an LSB. */
function chain(last, scaled) {
  const count = Math.floor(uniform(1, 5)), raw = [count]
  let parent = null
  for (let i = 0; i < count; i++) {
    const axis = randomAxis(), turn = randomTurn(), scale = scaled ? fixed(uniform(.5, 1.125)) : 65536
    const place = randomVector(10), node = i === count - 1 ? last : new THREE.Object3D()
    node.quaternion.copy(quaternion(axis, turn))
    node.scale.setScalar(real(scale))
    node.position.copy(vector(place))
    raw.push(...axis, turn, scale, ...place)
    if (parent) parent.add(node)
    parent = node
  }
  return raw
}

function update(node) {
  let top = node
  while (top.parent) top = top.parent
  top.updateMatrixWorld(true)
  return node
}

function nodes() {
  const last = new THREE.Object3D(), raw = chain(last, true)
  return { raw, matrix: update(last).matrixWorld }
}

function rider() {
  const last = new THREE.PerspectiveCamera(), raw = chain(last, false)
  return { raw, matrix: update(last).matrixWorldInverse }
}

function riderAt() {
  const last = new THREE.PerspectiveCamera(), raw = chain(last, false), look = randomLook(100)
  update(last)
  const along = vector(look.target).sub(new THREE.Vector3().setFromMatrixPosition(last.matrixWorld))
  if (along.length() < 5 || along.clone().cross(vector(look.up)).length() < .2 * along.length()) return riderAt()
  last.up.copy(vector(look.up))
  last.lookAt(vector(look.target))
  return { raw: [...raw, ...look.target, ...look.up], matrix: update(last).matrixWorldInverse }
}

const kinds = [
  ['perspective', perspective, 'PerspectiveCamera has the same projection matrix'],
  ['frustum', frustum, 'makePerspective off the centre gives the same matrix'],
  ['ortho', ortho, 'OrthographicCamera has the same projection matrix'],
  ['camera', camera, 'lookAt of a camera gives the same matrixWorldInverse'],
  ['object', object, 'lookAt of an object gives the same matrixWorld'],
  ['quaternion', rotation, 'setFromAxisAngle gives the same rotation'],
  ['product', product, 'multiply of quaternions gives the same rotation'],
  ['nodes', nodes, 'nested and scaled Object3D have the same matrixWorld'],
  ['rider', rider, 'a camera in nested nodes has the same matrixWorldInverse'],
  ['riderat', riderAt, 'lookAt of a camera in nested nodes gives the same matrixWorldInverse'],
]

// ---- comparing

const cases = kinds.map(([word, make]) => Array.from({ length: CASES }, () => ({ word, ...make() })))
const input = cases.flat().map((c) => `${c.word} ${c.raw.join(' ')}\n`).join('')
const run = spawnSync(dump, { input, maxBuffer: 1 << 26, encoding: 'utf8' })
const lines = run.stdout.split('\n').slice(0, -1)
if (run.status !== 0 || lines.length !== kinds.length * CASES) {
  console.log(`Bail out! ${dump}: status ${run.status}, ${lines.length} lines ${run.stderr}`)
  process.exit(1)
}

/* Largest difference of the 16 elements in LSB; three.js stores columns. A refusal is infinitely far off. */
function difference(line, matrix) {
  const got = line.split(' ').map(Number)
  if (got.length !== 16) return Infinity
  return Math.max(...got.map((v, i) => Math.abs(v - matrix.elements[i % 4 * 4 + (i >> 2)] * 65536)))
}

let failed = 0
cases.forEach((list, k) => {
  const worst = list.map((c, i) => difference(lines[k * CASES + i], c.matrix))
  const at = worst.indexOf(Math.max(...worst))
  const passed = worst[at] <= ALLOWED
  console.log(`${passed ? 'ok' : 'not ok'} ${k + 1} - ${kinds[k][2]}`)
  console.log(`# ${CASES} cases, at most ${worst[at].toFixed(2)} LSB`)
  if (!passed) {
    failed++
    console.log(`# ${list[at].word} ${list[at].raw.join(' ')}\n# firmware ${lines[k * CASES + at]}`)
    const e = list[at].matrix.elements
    console.log(`# three.js ${e.map((_, i) => (e[i % 4 * 4 + (i >> 2)] * 65536).toFixed(2)).join(' ')}`)
  }
})
console.log(`1..${kinds.length}`)
process.exit(failed > 0 ? 1 : 0)
