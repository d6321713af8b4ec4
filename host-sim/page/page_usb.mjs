// usb: an RP2040 or RP2350 in its boot loader over WebUSB, as host-sim/flash/usb/flash_usb.c has it over libusb. WebUSB has no
// time-outs, so each call has one here: nothing waits for longer than WAIT_MS. Sources: WebUSB API; the datasheets, see
// flash_boot.h.

const VENDOR = 0x2E8A, PRODUCTS = { rp2040: 0x0003, rp2350: 0x000F };
const RESET = 0x41, COMMAND_STATUS = 0x42, GET_STATUS = 0; // requests
const WAIT_MS = 3000, LEAVES_MS = 1000, TICK_MS = 50, PACKET = 64;
const EIO = -5, EACCES = -13, EBUSY = -16, ENODEV = -19, EPIPE = -32, ETIMEDOUT = -110; // flash_boot.h

const later = (ms, what) => new Promise((done) => setTimeout(done, ms, what));

// Resolves to what the promise does, or to null when it takes too long.
function within(promise, ms) {
    promise.catch(() => {}); // it may fail after that
    return Promise.race([promise, later(ms, null)]);
}

const isGone = (error) => error.name === 'NotFoundError' || /disconnected|NO_DEVICE/.test(error.message);

// Resolves to the board that the user chooses. It fails where there is none.
export const chooseBoard = (usb, chip) => usb.requestDevice({ filters: [{ vendorId: VENDOR, productId: PRODUCTS[chip] }] });

function statusOf(error, other) {
    return isGone(error) ? ENODEV : error.name === 'SecurityError' || /ACCESS/.test(error.message) ? EACCES : other;
}

// Finds the interface and its endpoints by class and direction, not by number.
async function claim(device) {
    if (device.configuration === null) {
        await device.selectConfiguration(1);
    }
    for (const { interfaceNumber, alternate } of device.configuration.interfaces) {
        if (alternate.interfaceClass === 0xFF && alternate.interfaceSubclass === 0 && alternate.interfaceProtocol === 0) {
            const [into, from] = ['in', 'out'].map((way) => alternate.endpoints.find(({ direction }) => direction === way)?.endpointNumber);
            await device.claimInterface(interfaceNumber);
            return { number: interfaceNumber, into, from };
        }
    }
    throw new Error('no interface of PICOBOOT');
}

// Resolves to { status } where the board cannot be opened; else to its transfers, each of which takes bytes or their number
// and resolves to { status, bytes }, with a status as in flash_boot.h; and close().
export async function openBoard(device) {
    let wrong = EIO;
    const close = () => within(Promise.resolve().then(() => device.close()), LEAVES_MS).catch(() => {});
    const opened = async () => {
        await device.open();
        wrong = EBUSY; // then only the interface can be another's
        return claim(device);
    };
    let found;
    try {
        found = await within(opened(), WAIT_MS);
    } catch (error) {
        await close();
        return { status: statusOf(error, wrong) };
    }
    if (found === null) {
        await close();
        return { status: EIO };
    }
    const { number, into, from } = found;
    const control = (request) => ({ requestType: 'vendor', recipient: 'interface', request, value: 0, index: number });
    const halted = (endpoint) => within(device.controlTransferIn({ requestType: 'standard', recipient: 'endpoint', request: GET_STATUS, value: 0, index: endpoint }, 2), WAIT_MS);

    // A board that was unplugged gives errors of all kinds until the system notices.
    const failed = async (error) => {
        for (let ms = 0, why = error; ms < LEAVES_MS; ms += TICK_MS) {
            if (isGone(why)) {
                return { status: ENODEV };
            }
            await later(TICK_MS);
            why = await halted(from).then(() => error, (other) => other);
        }
        return { status: EIO };
    };
    // size: how many bytes must have gone.
    const made = async (call, size) => {
        try {
            const result = await within(call(), WAIT_MS);
            if (result === null) {
                return { status: ETIMEDOUT };
            }
            const bytes = result.data && new Uint8Array(result.data.buffer, result.data.byteOffset, result.data.byteLength);
            const all = bytes?.length ?? result.bytesWritten;
            return { status: result.status === 'stall' ? EPIPE : result.status !== 'ok' || all !== size ? EIO : 0, bytes };
        } catch (error) {
            return failed(error);
        }
    };
    const unhalt = async (way, endpoint) => {
        const { data } = await halted(endpoint | (way === 'in' ? 0x80 : 0)) ?? {};
        if (data?.byteLength === 2 && data.getUint8(0) !== 0) {
            await within(device.clearHalt(way, endpoint), WAIT_MS);
        }
    };
    return {
        status: 0,
        out: (bytes) => made(() => device.transferOut(from, bytes), bytes.length),
        in: (bytes) => made(() => device.transferIn(into, Math.max(bytes.length, PACKET)), bytes.length),
        commandStatus: (bytes) => made(() => device.controlTransferIn(control(COMMAND_STATUS), bytes.length), bytes.length),
        async reset() {
            await unhalt('in', into).catch(() => {});
            await unhalt('out', from).catch(() => {});
            return made(() => device.controlTransferOut(control(RESET)), 0);
        },
        close,
    };
}
