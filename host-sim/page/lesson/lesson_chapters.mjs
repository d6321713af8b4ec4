// lesson_chapters: the slides of five lectures, in their order. chapters: [{ document, slide, title, text, address }]. An
// address opens the tab Lesson with the numbers of the slide, under the names of pinhole-sim's options; text says what to
// change there and what to look at.
import { lessonAddress } from './lesson_exercise.mjs';

const wideLens = 'size=200x100 fov=90 near=2 far=10', squareLens = 'size=100x100 fov=90 near=1 far=3', atOrigin = 'camera=eye=0,0,0,target=0,0,-1', usualPoint = 'camera=eye=0,0,5 point=1,2,-1';
const boxLens = 'size=100x100 projection=ortho=-2,6,-1,3 near=2 far=10', leftView = 'view-matrix=1,0,0,0,0,1,0,0,0,0,1,5,0,0,0,1';

// [slide, title, text, options]
const chapterRows = {
    HAW: [
        ['Parallel Projections', 'Parallel against perspective', 'Move the camera away, here and with a perspective. In parallel ndc.x and ndc.y stay; with a perspective both go to 0, the vanishing point.', `${boxLens} ${usualPoint}`],
        ['Pinhole camera displays image upside down', 'Upside down behind the hole', 'Give the focal length its other sign. The image turns over, and ndc.y changes its sign and nothing else.', `size=100x100 focal=-1,2 ${usualPoint}`],
        ['Parameters of the view frustum', 'Widths, heights and angles', 'Change the field of view: the height at the distance 2 is twice the distance times tan of half of the angle. The width is the aspect times that.', `${wideLens} ${usualPoint} frustum=2,2`],
        ['Zooming; Dollying', 'Zoom and dolly', 'A zoom changes the lens: view.z stays. A dolly changes the place: the matrix of the lens stays.', `size=100x100 focal=2,2 ${usualPoint}`],
        ['The camera in the scene', 'A camera is a node', 'The camera is a child of the moon. Take another frame: camera.matrix moves with the moon.', 'demo=solar camera=eye=0,0,2 parent=2'],
        ['Object3D.lookAt', 'Two kinds of lookAt', 'The object looks at the camera with its +z axis, the camera at the origin with its -z axis. Move the target and read world.x and view.z.', 'camera=eye=5,0,0 object=1,0,0,target=5,0,0 point=0,0,2'],
        ['Exercise 2', 'camera.matrix', 'The columns of camera.matrix are the axes and the place. Move the eye to (0, 0, 5): the rotation goes away.', 'camera=eye=5,0,0'],
        ['Projection as a matrix operation', 'Q(n,d) and the division', 'Q makes w from the normal of the plane. Change d: the divided point moves along its ray, and a second projection leaves it where it is.', `${atOrigin} flatten=plane=0,0,1,2 point=2,4,-4`],
        ['Example: self-made shadows', 'A shadow on the floor', 'The eye is the lamp, and the plane is the floor below it. Lower the floor from 1 to 3: the shadow goes out with it.', `${atOrigin} flatten=plane=0,1,0,1 point=1,-2,-4`],
        ['Exercise 5', 'Depth as a + b/z', 'Move the point from z = -1 to -3. ndc.z goes from -1 to 1, and is not 0 in the middle.', `${squareLens} ${atOrigin} point=0,0,-2`],
        ['Exercise 6', 'Q_ndc', 'Change near and far: only the third row changes. Follow the vertex from the camera through clip space to ndc.', `${wideLens} ${usualPoint}`],
        ['After step 3; Step 5: the viewport transform', 'Outside, and in pixels', 'Move the point until |x| is more than w: it leaves the picture. This test holds only for w above 0. Change the size and read the pixel.', 'projection=frustum=-1,3,-1,1 near=1 far=3 camera=eye=0,0,0,target=0,0,-1 point=9,3,-3'],
    ],
    KAIST: [
        ['4.1 Viewing Transformation', 'Eye, look-at point, up', 'Move the eye. The rows of R are right, up and back; the third points from the look-at point to the eye.', 'camera=eye=0,3,4'],
        ['Adjusted up-vector', 'Up is adjusted', 'The up vector you give is (0, 1, 0). The second row of R is the one at right angles to the view: raise the eye and it leans back.', 'camera=eye=0,4,3'],
        ['Equation 4.6', 'V = R T', 'T holds -eye, R the axes. Their product has another last column: -R times the eye.', 'camera=eye=5,0,0'],
        ['Equation 4.5', 'The inverse is the transpose', 'Compare R with the matrix of the camera: what is a row in one is a column in the other.', 'camera=eye=3,0,4'],
        ['Equation 4.7', 'Dropping z', 'The third row is 0, so z is lost. Move the point along z: nothing changes after the matrix.', `${atOrigin} flatten=kaist-4.7 point=2,4,-4`],
        ['Equation 4.8', 'The box becomes a cube', 'Put the point to the left border, x = -2: it goes to -1, as equation 4.9 checks.', `${boxLens} ${usualPoint}`],
        ['Equation 4.10', 'Similar triangles', 'Halve the focal length: y halves. Move the point to half of its distance: y doubles.', `size=100x100 focal=2,2 ${usualPoint}`],
        ['Equation 4.11', 'w = z', 'The last row copies z into w. Move the point further away, and watch the division by it.', `${atOrigin} flatten=kaist-4.11 point=2,4,-4`],
        ['Figure 4.6', 'The vanishing point', 'The point lies on a rail. Move it along z from -10 to -99: its pixel comes near to the middle, and never gets there.', `size=100x100 fov=90 ${atOrigin} point=1,-1,-10`],
        ['4.2.2 Common Questions', 'The bug\'s eye', 'A fisheye is no matrix: edges become curves. The radius is the angle times a scale. Change the field of view up to 240 degrees, and take the vertex behind the eye: 3,0,3.', 'demo=fisheye size=240x180 projection=fisheye fov=180 camera=eye=0,0,0,target=0,0,-3 point=3,0,-3'],
        ['4.2.2 Common Questions', 'Depth of field', 'What is far from the focal depth is blurred, by its depth. Move the vertex along z and read its blur; at 4 from the eye it is 0. Then change --focus: a wider aperture blurs more.', 'demo=focus size=240x180 fov=60 near=0.5 far=24 camera=eye=0,1,3,target=0,1,0 focus=4,8 point=1.5,1,-3.4'],
    ],
    EECE: [
        ['External Parameters', 'Outside and inside of a camera', 'Move the camera: the view changes. Change the lens: the projection changes. Neither touches the other.', `${wideLens} ${usualPoint}`],
        ['Moving Camera (2)', 'q = P V^-1 M p', 'The object has a matrix, the camera has one, and the camera\'s is inverted. Move either one and read world, view and clip.', 'camera=eye=5,0,0 object=1,0,0,target=5,0,0 point=0,0,2'],
        ['Moving Camera (3)', 'Moved together', 'Camera and object are both moved by (3, 4, 5). World differs; from view on all is as without it. Take both moves away to see.', `${wideLens} camera=eye=3,4,10,target=3,4,5 object=3,4,5 point=1,2,-1`],
        ['Moving Camera: OpenGL', 'rotate(-theta), translate(-p)', 'The camera is turned by 90 degrees about y. In the view the sine has the other sign, and the translation comes first.', 'camera=ypr=90,0,0,eye=0,0,5'],
        ['Moving Camera: PHIGS', 'VRP, VPN, VUP', 'The plane normal points towards the viewer, so it is the third row of the view. Change it and watch that row.', 'camera=vrp=3,2,5,vpn=1,0,0'],
        ['Moving Camera: LookAt', 'gluLookAt', 'Raise the eye: the third row of the view turns, and its length stays 1.', 'camera=eye=0,3,4,target=0,0,0,up=0,1,0'],
        ['Perspective Projection', 'w = z/d', 'Change d from 4 to 2: w doubles, and the divided z is d for every point.', `${atOrigin} flatten=eece=4 point=2,4,-8`],
        ['View Frustum (3)', 'Find the mistake: the far corner', 'The slide sends (r, t, -f) to the corner of the cube. Type 3,1,-3 as the point and read its clip coordinates; then the real far corner, 9,3,-3.', `projection=frustum=-1,3,-1,1 near=1 far=3 ${atOrigin} point=-1,-1,-1`],
        ['Orthographic Projection (2)', 'Find the mistake: plus or minus', 'The slide has plus signs in the last column. Here they are minus signs: put the point to x = -2 and see that it goes to -1.', `${boxLens} ${usualPoint}`],
        ['Canonical Clipping Volume', 'What is drawn', 'Move the point out of the cube: what has an ndc above 1 or below -1 is cut away.', `projection=frustum=-1,3,-1,1 near=1 far=3 ${atOrigin} point=9,3,-3`],
        ['Z-Buffer Algorithm', 'The nearer one stays', 'The picture shows the depth buffer: white is near. Move the point away and watch its code; ours is larger when nearer.', `${squareLens} ${atOrigin} point=0,0,-2 show=depth`],
        ['Be able to program a moving, variable zoom camera', 'A variable zoom', 'Change the focal length and the place at once, so that the point keeps its pixel.', `size=100x100 focal=1,2 ${usualPoint}`],
    ],
    4600: [
        ['Rasterizing 3D Scenes', 'Ignoring z', 'Without a division z is lost and w is 1. All distances look alike.', `${atOrigin} flatten=kaist-4.7 point=2,4,-4`],
        ['Pinhole Camera', 'y\' = y f / z', 'Double the focal length or halve the distance: both double y.', `size=100x100 focal=1,2 ${usualPoint}`],
        ['Field of View', 'Focal length and field of view', 'Shorten the focal length: the field of view grows, and everything becomes smaller.', `size=100x100 focal=2,2 ${usualPoint} frustum=3,3`],
        ['Projection Matrix', 'P and Q', 'P and Q send near to 0 and far to 1. Change both planes and read the third row.', `convention=d3d ${wideLens} ${leftView} point=1,2,-1`],
        ['Projection Matrix: the curve', 'Not linear', 'Move the point from near to far. Half of the depth range is used up soon behind the near plane.', `convention=d3d ${squareLens} ${atOrigin} point=0,0,-2`],
        ['Fitting to a Screen', 'S and A', 'Change the field of view: S is 1 over the tangent of half of it. Change the size: A divides x alone.', `convention=d3d ${wideLens} ${usualPoint}`],
        ['View Matrix', 'O T', 'The world of these notes is left-handed: z grows forward. Change the last column, and see T.', `convention=d3d ${wideLens} ${leftView} point=1,2,-1`],
        ['Converting Back to Pixel Coordinates', 'The pixel', 'Pixel.x is (NDC.x + 1) w/2 and Pixel.y is (1 - NDC.y) h/2. Move the point up: Pixel.y falls.', `convention=d3d ${wideLens} ${usualPoint}`],
        ['Projection Matrix: z-fighting', 'Too far apart', 'Move near from 2 to 0.01, and read how few codes are left at the point.', `${wideLens} ${usualPoint}`],
    ],
    LMU: [
        ['View Transformation', 'M = R T', 'First the camera goes to the origin, then its axes to ours. Move the eye: T changes, R does not while the direction stays.', `convention=lmu size=200x100 fov=90 near=-2 far=-10 ${usualPoint}`],
        ['Task 1 b) Camera Rotation', 'R^-1 = R^T', 'The columns of the camera\'s matrix are the rows of R. Turn the camera, and compare.', 'convention=lmu near=-2 far=-10 camera=eye=5,0,0'],
        ['Q: How to do it using quaternions?', 'By a quaternion', 'The quaternion (1, 0, 1, 0) turns by 90 degrees about y. Make its third number -1 and the view turns the other way.', 'camera=quat=1,0,1,0,eye=0,0,5'],
        ['Orthographic Projection', 'Scale times shift', 'T_ortho first shifts the middle of the box to the origin, then scales its sides to 2. Change one side and see both.', `convention=lmu size=100x100 projection=ortho=-2,6,-1,3 near=-2 far=-10 ${usualPoint}`],
        ['Task 2 c)', 'w1 and w2', 'w1 is n + f and w2 is -n f, with n and f below 0. Change near and check both.', `convention=lmu size=200x100 fov=90 near=-2 far=-10 ${usualPoint}`],
        ['Task 2 d)', 'T_persp', 'n and f are coordinates here, so they are below 0, and -1/tan stands in the diagonal. Compare with the convention gl, near 2 and far 10: the matrix differs, the pixel does not.', `convention=lmu size=200x100 fov=90 near=-2 far=-10 ${usualPoint}`],
        ['Math Behind the Hitchcock Zoom', 'Find the mistake: x and y are lost', 'w is z, below 0 for what is seen. The slide\'s product has no x and y of the point: move it, and see that clip.x and clip.y follow.', `convention=lmu size=200x100 fov=90 near=-2 far=-10 ${usualPoint}`],
        ['Viewport Transformation', 'y counts up', 'This viewport has no minus sign: move the point up, and pixel.y grows. With the convention gl it falls.', `convention=lmu size=200x100 fov=90 near=-2 far=-10 ${usualPoint}`],
        ['Task 4 - Step 1: dollyZoomFOV', 'The angle for a distance', 'fill.fov is the angle in which a height of 2 fills the picture. Halve the distance and read it: the tangent doubles, not the angle.', 'size=100x100 fov=90 camera=eye=0,0,2 frustum=2,2'],
        ['Task 4 - Step 1: dollyZoomDist', 'The distance for an angle', 'fill.distance is where a height of 3 fills the picture. Change the lens and read it.', 'size=100x100 focal=2,2 camera=eye=0,0,3 frustum=3,3'],
        ['More Math Behind the Hitchcock Zoom', 'The square condition', 'Width and height of the picture\'s view are equal only if the picture is square. Make it 200x100: a square subject no longer fills both.', 'size=100x100 fov=90 camera=eye=0,0,1 frustum=1,2'],
    ],
};

const chapterOrder = ['HAW', 'KAIST', 'EECE', '4600', 'LMU']; // a key that is a number would come first

const chapterOptions = (text) => text.split(' ').map((word) => [word.slice(0, word.indexOf('=')), word.slice(word.indexOf('=') + 1)]);

export const chapters = chapterOrder.flatMap((document) => chapterRows[document].map(([slide, title, text, options]) => ({ document, slide, title, text, address: lessonAddress(chapterOptions(options)) })));
