// An animated GIF (GIF89a) from pictures of one size: one palette for all, and of each picture only what has changed.
//
// Format: https://www.w3.org/Graphics/GIF/spec-gif89a.txt

const BITS = 8;
/** The index of pixels that stay as they were. */
const SAME = 255;

/** The colour's five highest bits of red, green and blue. */
const coarse = (rgba, i) => ((rgba[i] >> 3) << 10) | ((rgba[i + 1] >> 3) << 5) | (rgba[i + 2] >> 3);

/** The 255 most frequent colours, each the mean of its coarse one, and which of them is nearest to a coarse colour. */
function palette(frames) {
    const sums = new Map();
    for (const rgba of frames) {
        for (let i = 0; i < rgba.length; i += 4) {
            const key = coarse(rgba, i);
            const sum = sums.get(key) ?? [0, 0, 0, 0];
            if (sum[0] === 0) sums.set(key, sum);
            sum[0] += 1;
            for (let part = 0; part < 3; part++) sum[part + 1] += rgba[i + part];
        }
    }
    const colours = [...sums.values()].sort((a, b) => b[0] - a[0]).slice(0, SAME)
        .map(([count, ...parts]) => parts.map((part) => Math.round(part / count)));
    const known = new Map();
    const nearest = (key) => {
        let index = known.get(key);
        if (index === undefined) {
            const [count, ...parts] = sums.get(key);
            const far = colours.map((colour) => colour.reduce((sum, part, i) => sum + (part - parts[i] / count) ** 2, 0));
            index = far.indexOf(Math.min(...far));
            known.set(key, index);
        }
        return index;
    };
    return { colours, nearest };
}

/** The indices as codes of growing width, as GIF's variant of Lempel, Ziv and Welch has them. */
export function compress(indices) {
    const [clear, end] = [1 << BITS, (1 << BITS) + 1];
    const bytes = [];
    let [held, count, width, next, codes] = [0, 0, BITS + 1, end + 1, new Map()];
    const put = (code) => {
        held |= code << count;
        for (count += width; count >= 8; count -= 8) {
            bytes.push(held & 255);
            held >>>= 8;
        }
    };
    put(clear);
    let prefix = indices[0];
    for (let i = 1; i < indices.length; i++) {
        const key = (prefix << BITS) | indices[i];
        const code = codes.get(key);
        if (code !== undefined) {
            prefix = code;
            continue;
        }
        put(prefix);
        if (next < 4096) {
            codes.set(key, next);
            if (next === 1 << width) width += 1;
            next += 1;
        } else {
            put(clear);
            [width, next, codes] = [BITS + 1, end + 1, new Map()];
        }
        prefix = indices[i];
    }
    put(prefix);
    put(end);
    if (count > 0) bytes.push(held & 255);
    return Uint8Array.from(bytes);
}

/** The bytes of a GIF that repeats for ever. `frames` are RGBA bytes, `delay` is in hundredths of a second. */
export function gif(frames, width, height, delay) {
    const { colours, nearest } = palette(frames);
    const short = (number) => [number & 255, number >> 8];
    const parts = [Buffer.from("GIF89a"), Buffer.from([...short(width), ...short(height), 0xf7, 0, 0])];
    const table = Buffer.alloc(3 * 256);
    colours.forEach((colour, i) => table.set(colour, 3 * i));
    parts.push(table, Buffer.from([0x21, 0xff, 11]), Buffer.from("NETSCAPE2.0"), Buffer.from([3, 1, 0, 0, 0]));
    let before;
    for (const rgba of frames) {
        const now = new Uint8Array(width * height);
        for (let i = 0; i < now.length; i++) now[i] = nearest(coarse(rgba, 4 * i));
        const drawn = before ? now.map((index, i) => (index === before[i] ? SAME : index)) : now;
        // The old picture stays below, and one index is transparent.
        parts.push(Buffer.from([0x21, 0xf9, 4, before ? 0x05 : 0x04, ...short(delay), SAME, 0]));
        parts.push(Buffer.from([0x2c, 0, 0, 0, 0, ...short(width), ...short(height), 0, BITS]));
        const data = compress(drawn);
        for (let at = 0; at < data.length; at += 255) {
            const block = data.subarray(at, at + 255);
            parts.push(Buffer.from([block.length]), block);
        }
        parts.push(Buffer.from([0]));
        before = now;
    }
    parts.push(Buffer.from([0x3b]));
    return Buffer.concat(parts);
}
