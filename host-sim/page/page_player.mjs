// player: draws frame after frame at the pace of the kit's bus, at most 60 a second as pinhole-sim --window, times speed.

const SHORTEST_MS = 1000 / 60;
const BUDGET_MS = 12; // of the 16 ms between two pictures of a screen: the page must have time to answer

// draw() draws the next frame and returns how long it took on the bus in ms, or -1 to stop. told(playing) is called
// when it starts and stops, and second(frames/s) once a second meanwhile.
export function makePlayer(draw, told, second) {
    let playing = false, speed = 1, due = 0, drawn = 0, since = 0;
    const tick = (now) => {
        if (!playing) {
            return;
        }
        if (due < now - 250) { // it was hidden, or is too slow: the time of the next frame counts from now
            due = now;
        }
        const end = performance.now() + BUDGET_MS;
        while (playing && due <= now && performance.now() < end) {
            const ms = draw();
            drawn++;
            if (ms < 0) {
                player.pause();
            }
            due += speed > 0 ? Math.max(ms, SHORTEST_MS) / speed : 0;
        }
        if (now - since >= 1000) {
            second(drawn * 1000 / (now - since));
            drawn = 0;
            since = now;
        }
        requestAnimationFrame(tick);
    };
    const player = {
        play() {
            if (!playing) {
                playing = true;
                due = since = performance.now();
                drawn = 0;
                told(true);
                requestAnimationFrame(tick);
            }
        },
        pause() {
            playing = false;
            told(false);
        },
        toggle: () => (playing ? player.pause() : player.play()),
        isPlaying: () => playing,
        setSpeed(value) {
            speed = value;
            due = performance.now();
        },
    };
    return player;
}
