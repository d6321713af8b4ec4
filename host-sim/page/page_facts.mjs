// facts: choices and numbers as elements of the page.

export const at = (id) => document.getElementById(id);
export const count = (n) => n.toLocaleString('en');

export function fill(select, texts) {
    select.replaceChildren(...texts.map((text, i) => new Option(text, i)));
}

// Shows the cost of a frame: the numbers of --stats. The bus is the kit's, so its time is that of the board's clock.
export function showFacts(list, stats, crc, rate) {
    const facts = [
        ['crc32', crc],
        ['on the wire', `${count(stats.wire_bytes)} bytes`],
        ['time on the bus', `${(stats.bus_us / 1000).toFixed(2)} ms`],
        ['clock of the bus', `${+(stats.clock_hz / 1e6).toFixed(2)} MHz`],
        ['the bus allows', `${stats.fps.toFixed(1)} frames/s`],
        ['this page draws', rate > 0 ? `${rate.toFixed(1)} frames/s` : '-'],
        ['triangles drawn', `${count(stats.triangles_drawn)} of ${count(stats.triangles_in)}`],
        ['left out', count(stats.triangles_dropped)],
        ['depth', stats.depth],
    ];
    list.replaceChildren(...facts.flatMap(([name, value]) => {
        const dt = document.createElement('dt'), dd = document.createElement('dd');
        dt.textContent = name;
        dd.textContent = value;
        dd.dataset.name = name;
        return [dt, dd];
    }));
}
