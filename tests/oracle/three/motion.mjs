/*
 * Usage: node motion.mjs NODE_MODULES MOTION_DUMP FILE.gltf...
 * three.js plays each clip of each file that motion_file.mjs wrote, and so does the firmware (MOTION_DUMP prints its
 * vertices), of a file called far*.gltf in five frames. TAP on standard output, with the largest difference in LSB of
 * Q16.16 (2^-16) of a model of radius 1.
 */
import { spawnSync } from 'node:child_process'
import { readFileSync } from 'node:fs'
import { pathToFileURL } from 'node:url'

globalThis.self = globalThis
globalThis.ProgressEvent ??= class extends Event {} // which three.js makes while it loads
const [modules, dump, ...files] = process.argv.slice(2)
const THREE = await import(pathToFileURL(`${modules}/three/build/three.module.js`))
const { GLTFLoader } = await import(pathToFileURL(`${modules}/three/examples/jsm/loaders/GLTFLoader.js`))

const { default: validator } = await import(pathToFileURL(`${modules}/gltf-validator/index.js`))

const FRAMES = 80, FAR_STEP = 16
/* 2 LSB of arithmetic, and of 16-bit numbers: 1 of a position, 2 of the rotation of each of 4 joints above one another,
 * and what a point moves, some 4 lengths a second, in half a step of the keys' times, 2^-15 s. */
const ALLOWED = 2 + 1 + 4 * 2 + 4 * 2
/* Where numbers have any size: 1/1000 of the radius; of normals what motion.h says of axes that differ up to 1 : 64. */
const ALLOWED_FAR = 65.536, ALLOWED_NORMAL_FAR = 1 / 64
const ALLOWED_NORMAL = 1 / 1024 // motion.h; and the weights' times

const meshes = (scene) => {
  const skinned = [], others = []
  scene.traverse((o) => { if (o.isMesh) (o.isSkinnedMesh ? skinned : others).push(o) })
  return [...others, ...skinned] // as the reader has them
}
/* What moves a vertex: its node, or the mean of its joints. */
const place = (mesh, vertex) => {
  if (!mesh.isSkinnedMesh) return mesh.matrixWorld
  const { skinIndex, skinWeight } = mesh.geometry.attributes, sum = new Array(16).fill(0)
  for (let k = 0; k < 4; k++) {
    const joint = skinIndex.getComponent(vertex, k), m = new THREE.Matrix4().multiplyMatrices(mesh.skeleton.bones[joint].matrixWorld, mesh.skeleton.boneInverses[joint])
    m.elements.forEach((e, i) => { sum[i] += skinWeight.getComponent(vertex, k) * e })
  }
  return new THREE.Matrix4().fromArray(sum)
}
/* What targets add to a normal counts by their weights; then it has length one. */
const normal = (mesh, vertex) => {
  const n = new THREE.Vector3().fromBufferAttribute(mesh.geometry.attributes.normal, vertex)
  mesh.morphTargetInfluences?.forEach((w, k) => n.addScaledVector(new THREE.Vector3().fromBufferAttribute(mesh.geometry.morphAttributes.normal[k], vertex), w))
  return n.applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(place(mesh, vertex))).normalize()
}
/* Whether its axes may differ by more than 1 : 64: what is so thin has no normal to compare. */
const isThin = (mesh, vertex) => {
  const m = new THREE.Matrix3().setFromMatrix4(place(mesh, vertex)), e = m.elements
  return !(Math.abs(m.determinant()) * 8 >= Math.max(...[0, 3, 6].map((i) => Math.hypot(e[i], e[i + 1], e[i + 2]))) ** 3)
}
/* three.js takes four joints a vertex, and has made their weights sum to one. Of eight, all of which sum to one, the
 * four of the largest weights count. */
const reduce = ({ geometry }) => {
  const { skinIndex, skinWeight, joints_1: others, weights_1: more } = geometry.attributes
  for (let v = 0; others && v < skinIndex.count; v++) {
    const share = 1 - [0, 1, 2, 3].reduce((a, k) => a + more.getComponent(v, k), 0)
    const all = [0, 1, 2, 3].flatMap((k) => [[share * skinWeight.getComponent(v, k), skinIndex.getComponent(v, k)], [more.getComponent(v, k), others.getComponent(v, k)]])
    const four = all.sort((a, b) => b[0] - a[0]).slice(0, 4), sum = four.reduce((a, [w]) => a + w, 0)
    four.forEach(([weight, joint], k) => {
      skinWeight.setComponent(v, k, weight / sum)
      skinIndex.setComponent(v, k, joint)
    })
  }
}
const order = (mesh) => [...new Set(mesh.geometry.index.array)]

let count = 0, failed = 0
for (const file of files) {
  const isFar = file.split('/').pop().startsWith('far'), step = isFar ? FAR_STEP : 1
  const allowed = isFar ? ALLOWED_FAR : ALLOWED, allowedNormal = isFar ? ALLOWED_NORMAL_FAR : ALLOWED_NORMAL
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)))
  failed += issues.numErrors > 0
  console.log(`${issues.numErrors > 0 ? 'not ' : ''}ok ${++count} - ${file.split('/').pop()} is glTF to the validator${issues.messages.filter((m) => m.severity === 0).slice(0, 3).map((m) => ` ${m.code} ${m.pointer}`)}`)
  const gltf = await new GLTFLoader().parseAsync(readFileSync(file, 'utf8'), '')
  meshes(gltf.scene).forEach(reduce)
  for (const clip of gltf.animations) {
    const mixer = new THREE.AnimationMixer(gltf.scene)
    mixer.clipAction(clip).play()
    const said = spawnSync(dump, [file, clip.name, String(FRAMES), String(step)], { encoding: 'utf8', maxBuffer: 1 << 28 })
    const [fit, ...lines] = said.stdout.trim().split('\n').map((line) => line.split(' '))
    const [centre, scale] = [fit.slice(1, 4).map(Number), Number(fit[4])]
    let most = 0, where = '', turned = 0, compared = 0
    for (const [frame, number, ...numbers] of lines) {
      const time = clip.duration > 0 ? Math.floor(frame % (clip.duration * 30) * 65536 / 30) / 65536 : 0
      mixer.setTime(time)
      gltf.scene.updateMatrixWorld(true)
      const mesh = meshes(gltf.scene)[number]
      order(mesh).forEach((vertex, i) => {
        const p = mesh.getVertexPosition(vertex, new THREE.Vector3()).applyMatrix4(mesh.matrixWorld)
        p.toArray().forEach((v, k) => {
          const off = Math.abs((v - centre[k]) * scale * 65536 - Number(numbers[6 * i + k]))
          if (!(off <= most)) [most, where] = [off, `frame ${frame}, mesh ${number}, vertex ${vertex}`]
        })
        if (isFar && isThin(mesh, vertex)) return
        compared++
        normal(mesh, vertex).toArray().forEach((v, k) => { turned = Math.max(turned, Math.abs(v - Number(numbers[6 * i + 3 + k]) / 16384)) })
      })
    }
    const ok = lines.length === Math.ceil(FRAMES / step) * 4 && most <= allowed && turned <= allowedNormal && compared > 100
    failed += !ok
    console.log(`${ok ? '' : 'not '}ok ${++count} - ${file.split('/').pop().replace('.gltf', '')} plays '${clip.name}' as three.js: off by ${most.toFixed(1)} of ${allowed} LSB (${where}), normals by ${turned.toFixed(5)}`)
  }
}
console.log(`1..${count}`)
process.exit(failed ? 1 : 0)
