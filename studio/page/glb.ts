// Reads the models that the libraries write: binary glTF 2.0 with one node and one mesh; each primitive has
// positions, a single colour or a colour for each corner, and normals; without normals its triangles are flat. Everything
// is checked before it is used.

export interface ModelPart {
    positions: Float32Array; // three for each corner
    normals: Float32Array;
    corners: Uint32Array; // three for each triangle
    colour: [number, number, number, number]; // linear, 0 to 1
    colours: Float32Array | null; // three for each corner, likewise, instead of `colour`
    isTwoSided: boolean;
}

export interface Model {
    parts: ModelPart[];
    low: [number, number, number]; // of all positions
    high: [number, number, number];
    triangles: number;
    bytes: number;
}

export class BadModel extends Error {
    constructor(what: string) {
        super(`the model cannot be read: ${what}`);
    }
}

const mostParts = 4096;
const mostJson = 64 * 1024 * 1024;

type Json = { [name: string]: unknown };

function fail(what: string): never {
    throw new BadModel(what);
}

function list(json: Json, name: string): Json[] {
    const value = json[name];
    if (!Array.isArray(value) || value.length > 4 * mostParts) fail(`'${name}' is not a list`);
    return value as Json[];
}

function whole(value: unknown, what: string, absent?: number): number {
    if (value === undefined && absent !== undefined) return absent;
    if (typeof value !== "number" || !Number.isSafeInteger(value) || value < 0) fail(`${what} is not a whole number`);
    return value as number;
}

export function readModel(bytes: Uint8Array): Model {
    const { json, binary } = chunks(bytes);
    const accessors = list(json, "accessors");
    const views = list(json, "bufferViews");
    const materials = list(json, "materials");
    const mesh = list(json, "meshes")[0] ?? fail("no mesh");
    const primitives = list(mesh, "primitives");
    if (primitives.length > mostParts) fail("too many parts");

    const numbers = (index: unknown, type: string, component: number) => {
        const accessor = accessors[whole(index, "an accessor")] ?? fail("an accessor is missing");
        if (accessor["type"] !== type || accessor["componentType"] !== component) fail("an accessor of the wrong type");
        const view = views[whole(accessor["bufferView"], "a view")] ?? fail("a view is missing");
        const count = whole(accessor["count"], "a count") * (type === "VEC3" ? 3 : 1);
        const start = whole(view["byteOffset"], "an offset", 0) + whole(accessor["byteOffset"], "an offset", 0);
        const room = whole(view["byteLength"], "a length") - whole(accessor["byteOffset"], "an offset", 0);
        if (view["byteStride"] !== undefined) fail("strided views are not supported");
        if (count * 4 > room || start + count * 4 > binary.byteLength) fail("a view extends beyond the end");
        return binary.slice(start, start + count * 4).buffer as ArrayBuffer; // aligned
    };

    const low: [number, number, number] = [Infinity, Infinity, Infinity];
    const high: [number, number, number] = [-Infinity, -Infinity, -Infinity];
    let triangles = 0;
    const parts = primitives.map((primitive): ModelPart => {
        if (whole(primitive["mode"], "a mode", 4) !== 4) fail("a part does not consist of triangles");
        const attributes = (primitive["attributes"] ?? {}) as Json;
        const positions = new Float32Array(numbers(attributes["POSITION"], "VEC3", 5126));
        const given = attributes["NORMAL"];
        const normals = given === undefined ? null : new Float32Array(numbers(given, "VEC3", 5126));
        const corners = new Uint32Array(numbers(primitive["indices"], "SCALAR", 5125));
        if ((normals && normals.length !== positions.length) || corners.length % 3) fail("some corners have no normal");
        const count = positions.length / 3;
        for (const corner of corners) if (corner >= count) fail("a corner is missing");
        for (let index = 0; index < positions.length; ++index) {
            const value = positions[index]!;
            if (!Number.isFinite(value)) fail("a position is not finite");
            const axis = index % 3;
            if (value < low[axis]!) low[axis] = value;
            if (value > high[axis]!) high[axis] = value;
        }
        triangles += corners.length / 3;
        const hues = attributes["COLOR_0"];
        const colours = hues === undefined ? null : new Float32Array(numbers(hues, "VEC3", 5126));
        if (colours && colours.length !== positions.length) fail("some corners have no colour");
        if (colours && !colours.every((value) => value >= 0 && value <= 1)) fail("invalid colour");
        const material = materials[whole(primitive["material"], "a material")] ?? fail("a material is missing");
        const rest = { colour: colourOf(material), isTwoSided: material["doubleSided"] === true };
        if (!normals) return { ...flat(positions, corners, colours), ...rest };
        return { positions, normals, corners, colours, ...rest };
    });
    if (triangles === 0) fail("no triangles");
    return { parts, low, high, triangles, bytes: binary.byteLength };
}

// Every triangle with corners of its own, whose normals are that of its plane.
function flat(
    positions: Float32Array,
    corners: Uint32Array,
    colours: Float32Array | null,
): Pick<ModelPart, "positions" | "normals" | "corners" | "colours"> {
    const spread = (values: Float32Array) => {
        const result = new Float32Array(3 * corners.length);
        corners.forEach((corner, at) => result.set(values.subarray(3 * corner, 3 * corner + 3), 3 * at));
        return result;
    };
    const apart = spread(positions);
    const normals = new Float32Array(apart.length);
    for (let at = 0; at < apart.length; at += 9) {
        const side = (from: number, axis: number) => apart[at + from + axis]! - apart[at + axis]!;
        const [ax, ay, az, bx, by, bz] = [side(3, 0), side(3, 1), side(3, 2), side(6, 0), side(6, 1), side(6, 2)];
        const normal = [ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx];
        const length = Math.hypot(...normal) || 1;
        for (let axis = 0; axis < 9; ++axis) normals[at + axis] = normal[axis % 3]! / length;
    }
    return { positions: apart, normals, corners: corners.map((_, at) => at), colours: colours && spread(colours) };
}

function colourOf(material: Json): ModelPart["colour"] {
    const surface = (material["pbrMetallicRoughness"] ?? {}) as Json;
    const factor = surface["baseColorFactor"] ?? [1, 1, 1, 1];
    const isColour =
        Array.isArray(factor) &&
        factor.length === 4 &&
        factor.every((value) => typeof value === "number" && value >= 0 && value <= 1);
    if (!isColour) fail("invalid colour");
    return factor as ModelPart["colour"];
}

// The header, the JSON and the binary data.
function chunks(bytes: Uint8Array): { json: Json; binary: Uint8Array } {
    const data = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.byteLength < 28 || data.getUint32(0, true) !== 0x46546c67) fail("not binary glTF");
    if (data.getUint32(4, true) !== 2) fail("unsupported version of glTF");
    if (data.getUint32(8, true) !== bytes.byteLength) fail("wrong length");
    const textLength = data.getUint32(12, true);
    if (data.getUint32(16, true) !== 0x4e4f534a || textLength > mostJson) fail("no JSON");
    const next = 20 + textLength;
    if (textLength % 4 || next + 8 > bytes.byteLength) fail("the JSON is truncated");
    const binaryLength = data.getUint32(next, true);
    if (data.getUint32(next + 4, true) !== 0x004e4942 || next + 8 + binaryLength > bytes.byteLength) fail("no numbers");
    let json: unknown;
    try {
        json = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes.subarray(20, next)));
    } catch {
        fail("invalid JSON");
    }
    if (typeof json !== "object" || json === null || Array.isArray(json)) fail("the JSON is not an object");
    return { json: json as Json, binary: bytes.subarray(next + 8, next + 8 + binaryLength) };
}
