// Reading models, and views of them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { load } from "./load.mjs";

const { readModel } = await load("glb");
const { readEye, eyeText, axes, seenBy, towards, between } = await load("eye");

function glb(json, binary) {
    let text = JSON.stringify(json);
    text = text.padEnd(Math.ceil(text.length / 4) * 4);
    const bytes = new Uint8Array(12 + 8 + text.length + 8 + binary.byteLength);
    const data = new DataView(bytes.buffer);
    [0x46546c67, 2, bytes.length, text.length, 0x4e4f534a].forEach((value, index) =>
        data.setUint32(4 * index, value, true),
    );
    bytes.set(new TextEncoder().encode(text), 20);
    data.setUint32(20 + text.length, binary.byteLength, true);
    data.setUint32(24 + text.length, 0x004e4942, true);
    bytes.set(new Uint8Array(binary), 28 + text.length);
    return bytes;
}

function triangle(change = () => {}) {
    const binary = new ArrayBuffer(84);
    new Float32Array(binary).set([0, 0, 0, 2, 0, 0, 0, 3, -1, 0, 0, 1, 0, 0, 1, 0, 0, 1]);
    new Uint32Array(binary, 72).set([0, 1, 2]);
    const json = {
        meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0 }] }],
        materials: [{ pbrMetallicRoughness: { baseColorFactor: [0.1, 0.2, 0.3, 1] }, doubleSided: true }],
        accessors: [
            { bufferView: 0, componentType: 5126, count: 3, type: "VEC3" },
            { bufferView: 1, componentType: 5126, count: 3, type: "VEC3" },
            { bufferView: 2, componentType: 5125, count: 3, type: "SCALAR" },
        ],
        bufferViews: [
            { buffer: 0, byteOffset: 0, byteLength: 36 },
            { buffer: 0, byteOffset: 36, byteLength: 36 },
            { buffer: 0, byteOffset: 72, byteLength: 12 },
        ],
    };
    return glb(json, change(json, binary) ?? binary);
}

test("a model is read", () => {
    const model = readModel(triangle());
    assert.equal(model.triangles, 1);
    assert.deepEqual(model.low, [0, 0, -1]);
    assert.deepEqual(model.high, [2, 3, 0]);
    assert.deepEqual(model.parts[0].colour, [0.1, 0.2, 0.3, 1]);
    assert.ok(model.parts[0].isTwoSided);
    assert.deepEqual([...model.parts[0].corners], [0, 1, 2]);
});

/// A triangle whose corners are red, green and blue.
function blend(change = () => {}) {
    return triangle((json, binary) => {
        const longer = new Float32Array(21 + 9);
        longer.set(new Float32Array(binary, 0, 18));
        new Uint32Array(longer.buffer, 72).set([0, 1, 2]);
        longer.set([1, 0, 0, 0, 1, 0, 0, 0, 1], 21);
        json.accessors.push({ bufferView: 3, componentType: 5126, count: 3, type: "VEC3" });
        json.bufferViews.push({ buffer: 0, byteOffset: 84, byteLength: 36 });
        json.meshes[0].primitives[0].attributes.COLOR_0 = 3;
        change(json, longer);
        return longer.buffer;
    });
}

test("colours of corners are read", () => {
    assert.equal(readModel(triangle()).parts[0].colours, null);
    assert.deepEqual([...readModel(blend()).parts[0].colours], [1, 0, 0, 0, 1, 0, 0, 0, 1]);
    for (const [message, change] of [
        ["invalid colour", (_, numbers) => (numbers[22] = NaN)],
        ["some corners have no colour", (json) => (json.accessors[3].count = 2)],
        ["wrong type", (json) => (json.accessors[3].type = "VEC4")],
    ]) {
        assert.throws(() => readModel(blend(change)), new RegExp(message));
    }
});

test("triangles without normals are flat", () => {
    const flat = readModel(blend((json) => delete json.meshes[0].primitives[0].attributes.NORMAL)).parts[0];
    // (2, 0, 0) x (0, 3, -1) = (0, 2, 6)
    const [, y, z] = flat.normals;
    assert.ok(Math.abs(y - 2 / Math.hypot(2, 6)) < 1e-6 && Math.abs(z - 6 / Math.hypot(2, 6)) < 1e-6);
    assert.deepEqual([...flat.normals.slice(3)], [...flat.normals.slice(0, 3), ...flat.normals.slice(0, 3)]);
    assert.deepEqual([...flat.positions], [0, 0, 0, 2, 0, 0, 0, 3, -1]);
    assert.deepEqual([...flat.colours], [1, 0, 0, 0, 1, 0, 0, 0, 1]);
    assert.deepEqual([...flat.corners], [0, 1, 2]);
});

test("invalid models are refused", () => {
    const faults = {
        "a corner is missing": (_, binary) => {
            new Uint32Array(binary, 72)[1] = 3;
        },
        "not finite": (_, binary) => {
            new Float32Array(binary)[4] = NaN;
        },
        "beyond the end": (json) => {
            json.bufferViews[2].byteLength = json.accessors[2].count = 99;
        },
        "wrong type": (json) => {
            json.accessors[0].componentType = 5125;
        },
        "not a whole number": (json) => {
            json.accessors[2].count = 1.5;
        },
        "a view is missing": (json) => {
            json.accessors[0].bufferView = 7;
        },
        "a material is missing": (json) => {
            json.meshes[0].primitives[0].material = 1;
        },
        "'materials' is not a list": (json) => {
            delete json.materials;
        },
        "invalid colour": (json) => {
            json.materials[0].pbrMetallicRoughness.baseColorFactor = [9, 0, 0, 1];
        },
        "no triangles": (json) => {
            json.meshes[0].primitives = [];
        },
        "does not consist of triangles": (json) => {
            json.meshes[0].primitives[0].mode = 1;
        },
    };
    for (const [message, change] of Object.entries(faults)) {
        assert.throws(() => readModel(triangle(change)), new RegExp(message), message);
    }
    const whole = triangle();
    for (let length = 0; length < whole.length; length += 7) assert.throws(() => readModel(whole.slice(0, length)));
    for (let at = 0; at < 20; ++at) {
        const wrong = whole.slice();
        wrong[at] ^= 0xff;
        assert.throws(() => readModel(wrong), `byte ${at}`);
    }
});

test("the eye is read and written as the key view", () => {
    assert.deepEqual(readEye("30 15"), { azimuth: 30, elevation: 15, distance: null });
    assert.deepEqual(readEye("side"), { azimuth: 90, elevation: 0, distance: null });
    assert.deepEqual(readEye("top perspective"), { azimuth: 0, elevation: 90, distance: 4 });
    assert.deepEqual(readEye("-30,15,perspective,2.5"), { azimuth: -30, elevation: 15, distance: 2.5 });
    for (const text of ["", "30", "30 95", "a b", "30 15 flat", "30 15 perspective 0.5", "front 1 2 3"])
        assert.equal(readEye(text), null);
    for (const text of ["30,15", "-12.5,0,perspective", "10,-90,perspective,2.5"])
        assert.equal(eyeText(readEye(text)), text);
    assert.equal(eyeText({ azimuth: 390, elevation: 0, distance: null }), "30,0");
    assert.equal(between(-190), 170);
});

test("the middle stays in the middle, what is right lies right, what is near lies before", () => {
    const at = (matrix, point) => {
        const [x, y, z, w] = [0, 1, 2, 3].map((row) =>
            point.reduce((sum, value, column) => sum + matrix[column * 4 + row] * value, matrix[12 + row]),
        );
        return [x / w, y / w, z / w];
    };
    const middle = [1, 2, 3];
    for (const distance of [null, 40]) {
        const matrix = seenBy(axes(90, 0), middle, { across: 10, up: 10, deep: 20 }, distance);
        assert.ok(
            at(matrix, middle)
                .slice(0, 2)
                .every((value) => Math.abs(value) < 1e-6),
        );
        const right = at(matrix, [1, 2, -2]); // seen from the side, z lies to the left
        assert.ok(Math.abs(right[0] - 0.5) < 1e-6 && Math.abs(right[1]) < 1e-6);
        assert.ok(at(matrix, [5, 2, 3])[2] < at(matrix, [-5, 2, 3])[2]);
        assert.ok(Math.abs(at(matrix, [5, 2, 3])[2]) < 1);
    }
    assert.deepEqual(
        towards(0, 0).map((value) => Math.round(value)),
        [0, 0, 1],
    );
});
