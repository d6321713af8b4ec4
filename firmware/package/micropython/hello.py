# Pinhole in MicroPython: a cube in colours, a textured floor, text; then a model of one's own, if there is one.
#
#   micropython hello.py                 writes hello.ppm, 240x240
#   micropython hello.py FILE.phs        ... of a binary scene that pinhole-asset has written
#
# A kit with a driver for its display (st7789.py and the like) sends the same bytearray; with little memory show() takes
# a function, which gets the picture in bands of 16 lines: renderer.show(lambda y, lines, pixels: display.blit(..)).
import math
import sys
import pinhole

WIDTH = HEIGHT = 240


def cube():
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]
    colours = [0x404040 + (0xBF0000 * (x > 0)) + (0xBF00 * (y > 0)) + (0xBF * (z > 0)) for x, y, z in corners]
    return pinhole.Mesh(corners, triangles, colours=colours, lit=False)


def floor():
    texels = bytearray(2 * 8 * 8)
    for i in range(64):
        texels[2 * i : 2 * i + 2] = (0xE71C if (i + i // 8) % 2 else 0x39C7).to_bytes(2, sys.byteorder)
    squares = pinhole.Texture(texels, 8, 8)
    corners = [(-4, -1.5, -4), (-4, -1.5, 4), (4, -1.5, 4), (4, -1.5, -4)]
    return pinhole.Mesh(corners, [(0, 1, 2), (0, 2, 3)], uvs=[(0, 0), (0, 1), (1, 1), (1, 0)], texture=squares)


def ball(rings=12):
    points, triangles = [], []
    for i in range(rings + 1):
        for k in range(2 * rings):
            a, b = math.pi * i / rings, math.pi * k / rings
            points.append((math.sin(a) * math.cos(b), math.cos(a), math.sin(a) * math.sin(b)))
    for i in range(rings):
        for k in range(2 * rings):
            a, b = 2 * rings * i + k, 2 * rings * i + (k + 1) % (2 * rings)
            c, d = a + 2 * rings, b + 2 * rings
            triangles += [(b, d, c)] if i == 0 else [(a, b, c)] if i == rings - 1 else [(a, b, c), (b, d, c)]
    return pinhole.Mesh(points, triangles, colour=0xFF8800)


def scene(renderer):
    renderer.begin(eye=(3, 3, 6), target=(0, 0, 0), near=1, far=50, background=0x141A26)
    renderer.draw(floor())
    renderer.draw(cube(), position=(-1.2, 0, 0), turn=(20, 30, 0), scale=0.8)
    renderer.draw(ball(), position=(1.4, -0.5, 0))


def save(picture, name):
    with open(name, "wb") as file:
        file.write(b"P6\n%d %d\n255\n" % (WIDTH, HEIGHT))
        for i in range(0, len(picture), 2):
            pixel = int.from_bytes(picture[i : i + 2], sys.byteorder)
            file.write(bytes(((pixel >> 11) * 255 // 31, (pixel >> 5 & 63) * 255 // 63, (pixel & 31) * 255 // 31)))


picture = bytearray(2 * WIDTH * HEIGHT)
if len(sys.argv) > 1:
    with open(sys.argv[1], "rb") as file:
        model = pinhole.Model(file.read())
    vertices, triangles = model.need()
    renderer = pinhole.Renderer(WIDTH, HEIGHT, vertices=vertices, triangles=triangles)
    model.draw(renderer, orbit=30)
else:
    renderer = pinhole.Renderer(WIDTH, HEIGHT)
    scene(renderer)
renderer.show(picture)
renderer.text(picture, 8, 8, "Hello, Pinhole", outline=0, scale=2)
drawn, dropped, why = renderer.stats()
print(drawn, "triangles;", why or "%d had no room" % dropped)
save(picture, "hello.ppm")
