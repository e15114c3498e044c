// Draws models with WebGL2: light, shadows and a lit ground.
import { axes, seenBy, towards, type Eye, type Matrix, type Vector } from "./eye";
import type { Model } from "./glb";
import {
    groundFragment,
    groundVertex,
    modelFragment,
    modelVertex,
    shadowFragment,
    shadowVertex,
} from "./space_shaders";

/// A model on the graphics processor.
export interface Staged {
    readonly low: Vector;
    readonly high: Vector;
    readonly triangles: number;
    readonly bytes: number;
    readonly array: WebGLVertexArrayObject;
    readonly buffers: readonly WebGLBuffer[];
    readonly corners: number;
}

export interface Scene {
    readonly models: readonly { model: Staged; presence: number }[]; // 0 to 1, for transitions
    readonly frame: { low: Vector; high: Vector }; // box that the picture is framed for
    readonly eye: Eye;
    readonly half: number; // of the shorter side of the picture, in steps, at zoom 1
    readonly zoom: number;
    readonly shift: readonly [number, number]; // of the picture, in halves of its size
    readonly light: { azimuth: number; elevation: number };
    readonly isDark: boolean;
}

const shadowSide = 2048;
const stride = 20; // bytes per corner: position, normal, colour

interface Program {
    program: WebGLProgram;
    at: (name: string) => WebGLUniformLocation | null;
}

export class Stage {
    private readonly model: Program;
    private readonly shadow: Program;
    private readonly ground: Program;
    private readonly shadows: WebGLTexture;
    private readonly shadowFrame: WebGLFramebuffer;
    private readonly floor: WebGLVertexArrayObject;
    private shadowed = ""; // state for which the shadows were drawn

    /// Null if the browser does not support WebGL2, or its graphics driver fails.
    static on(canvas: HTMLCanvasElement): Stage | null {
        try {
            const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
            return gl && new Stage(gl);
        } catch (error) {
            console.error(error);
            return null;
        }
    }

    private constructor(private readonly gl: WebGL2RenderingContext) {
        this.model = this.compile(modelVertex, modelFragment);
        this.shadow = this.compile(shadowVertex, shadowFragment);
        this.ground = this.compile(groundVertex, groundFragment);
        this.shadows = gl.createTexture()!;
        gl.bindTexture(gl.TEXTURE_2D, this.shadows);
        gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, shadowSide, shadowSide);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        this.shadowFrame = gl.createFramebuffer()!;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowFrame);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.shadows, 0);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        this.floor = gl.createVertexArray()!;
        gl.bindVertexArray(this.floor);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
        gl.bindVertexArray(null);
    }

    private compile(vertex: string, fragment: string): Program {
        const { gl } = this;
        const program = gl.createProgram()!;
        for (const [kind, source] of [
            [gl.VERTEX_SHADER, vertex],
            [gl.FRAGMENT_SHADER, fragment],
        ] as const) {
            const shader = gl.createShader(kind)!;
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            gl.attachShader(program, shader);
        }
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
            throw new Error(`the graphics driver rejected a program: ${gl.getProgramInfoLog(program)}`);
        }
        const places = new Map<string, WebGLUniformLocation | null>();
        return {
            program,
            at: (name) => {
                if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
                return places.get(name)!;
            },
        };
    }

    /// Copies a model to the graphics processor.
    add(model: Model): Staged {
        const { gl } = this;
        const count = model.parts.reduce((sum, part) => sum + part.positions.length / 3, 0);
        const corners = model.parts.reduce((sum, part) => sum + part.corners.length, 0);
        const packed = new DataView(new ArrayBuffer(count * stride));
        const order = new Uint32Array(corners);
        let first = 0;
        let next = 0;
        for (const { positions, normals, corners: those, colour, colours, isTwoSided } of model.parts) {
            const hue = packedColour(colour, isTwoSided);
            for (let index = 0, offset = first * stride; index < positions.length; index += 3, offset += stride) {
                for (let axis = 0; axis < 3; ++axis) {
                    packed.setFloat32(offset + 4 * axis, positions[index + axis]!, true);
                }
                packed.setUint32(offset + 12, packedNormal(normals, index), true);
                const own = colours
                    ? packedColour([colours[index]!, colours[index + 1]!, colours[index + 2]!], isTwoSided)
                    : hue;
                packed.setUint32(offset + 16, own, true);
            }
            for (let index = 0; index < those.length; ++index) order[next++] = those[index]! + first;
            first += positions.length / 3;
        }
        const array = gl.createVertexArray()!;
        gl.bindVertexArray(array);
        const buffers = [gl.createBuffer()!, gl.createBuffer()!];
        gl.bindBuffer(gl.ARRAY_BUFFER, buffers[0]!);
        gl.bufferData(gl.ARRAY_BUFFER, packed, gl.STATIC_DRAW);
        gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[1]!);
        gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, order, gl.STATIC_DRAW);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 3, gl.FLOAT, false, stride, 0);
        gl.enableVertexAttribArray(1);
        gl.vertexAttribPointer(1, 4, gl.BYTE, true, stride, 12);
        gl.enableVertexAttribArray(2);
        gl.vertexAttribPointer(2, 4, gl.UNSIGNED_BYTE, true, stride, 16);
        gl.bindVertexArray(null);
        return {
            low: model.low,
            high: model.high,
            triangles: model.triangles,
            corners,
            array,
            buffers,
            bytes: packed.byteLength + order.byteLength,
        };
    }

    remove(model: Staged): void {
        this.gl.deleteVertexArray(model.array);
        for (const buffer of model.buffers) this.gl.deleteBuffer(buffer);
    }

    /// Shows nothing.
    clear(): void {
        const { gl } = this;
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    }

    draw(scene: Scene): void {
        const { gl } = this;
        const { width, height } = gl.canvas;
        const middle = middleOf(scene.frame);
        const radius = radiusOf(scene.frame);
        const sun = this.shine(scene, middle, radius);
        const smaller = Math.min(width, height);
        const half = scene.half / scene.zoom;
        const frame = axes(scene.eye.azimuth, scene.eye.elevation);
        const seen = { across: (half * width) / smaller, up: (half * height) / smaller, deep: radius * 4 };
        const aim = moved(middle, frame, -scene.shift[0] * seen.across, -scene.shift[1] * seen.up);
        const eye = seenBy(frame, aim, seen, scene.eye.distance === null ? null : scene.eye.distance * radius);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, width, height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        gl.activeTexture(gl.TEXTURE0);
        gl.bindTexture(gl.TEXTURE_2D, this.shadows);

        this.drawGround(scene, eye, sun, middle, radius);
        const { program, at } = this.model;
        gl.useProgram(program);
        gl.enable(gl.DEPTH_TEST);
        gl.disable(gl.BLEND);
        gl.uniformMatrix4fv(at("eye"), false, eye);
        gl.uniformMatrix4fv(at("sun"), false, sun);
        gl.uniform3fv(at("light"), towards(scene.light.azimuth, scene.light.elevation) as [number, number, number]);
        gl.uniform3fv(at("back"), frame.back as [number, number, number]);
        gl.uniform1f(at("nudge"), radius / 400);
        gl.uniform1f(at("texel"), 1 / shadowSide);
        gl.uniform1i(at("shadows"), 0);
        const tall = scene.frame.high[1] - scene.frame.low[1];
        gl.uniform2f(at("heights"), scene.frame.low[1], tall > 0 ? 1 / tall : 1);
        for (const { model, presence } of scene.models) {
            gl.uniform1f(at("presence"), presence);
            gl.bindVertexArray(model.array);
            gl.drawElements(gl.TRIANGLES, model.corners, gl.UNSIGNED_INT, 0);
        }
        gl.bindVertexArray(null);
    }

    // The shadow map: the depth as seen from the light.
    private shine(scene: Scene, middle: Vector, radius: number): Matrix {
        const { gl } = this;
        const { azimuth, elevation } = scene.light;
        const sun = seenBy(
            axes(azimuth, elevation),
            middle,
            { across: radius * 1.02, up: radius * 1.02, deep: radius * 2.2 },
            null,
        );
        const shown = scene.models.filter(({ presence }) => presence >= 0.5);
        const what = JSON.stringify([azimuth, elevation, scene.frame, shown.map(({ model }) => this.numberOf(model))]);
        if (what === this.shadowed) return sun;
        this.shadowed = what;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowFrame);
        gl.viewport(0, 0, shadowSide, shadowSide);
        gl.enable(gl.DEPTH_TEST);
        gl.disable(gl.BLEND);
        gl.clear(gl.DEPTH_BUFFER_BIT);
        gl.useProgram(this.shadow.program);
        gl.uniformMatrix4fv(this.shadow.at("sun"), false, sun);
        gl.enable(gl.POLYGON_OFFSET_FILL);
        gl.polygonOffset(1.5, 2);
        for (const { model } of shown) {
            gl.bindVertexArray(model.array);
            gl.drawElements(gl.TRIANGLES, model.corners, gl.UNSIGNED_INT, 0);
        }
        gl.disable(gl.POLYGON_OFFSET_FILL);
        gl.bindVertexArray(null);
        return sun;
    }

    private readonly numbers = new WeakMap<Staged, number>();
    private numbered = 0;
    private numberOf(model: Staged): number {
        let number = this.numbers.get(model);
        if (number === undefined) this.numbers.set(model, (number = ++this.numbered));
        return number;
    }

    // The ground is invisible from below, and fades in at low elevations.
    private drawGround(scene: Scene, eye: Matrix, sun: Matrix, middle: Vector, radius: number): void {
        const presence = Math.min(1, Math.max(0, scene.eye.elevation / 6));
        if (presence === 0) return;
        const { gl } = this;
        const { program, at } = this.ground;
        gl.useProgram(program);
        gl.disable(gl.DEPTH_TEST);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
        gl.uniformMatrix4fv(at("eye"), false, eye);
        gl.uniformMatrix4fv(at("sun"), false, sun);
        gl.uniform3f(at("middle"), middle[0], scene.frame.low[1], middle[2]);
        gl.uniform1f(at("reach"), radius * 1.9);
        gl.uniform1f(at("texel"), 2.5 / shadowSide);
        gl.uniform1i(at("shadows"), 0);
        gl.uniform1f(at("strength"), scene.isDark ? 0.6 : 0.36);
        gl.uniform1f(at("presence"), presence);
        const [red, green, blue, alpha] = scene.isDark ? [0.34, 0.27, 0.22, 0.55] : [0.86, 0.78, 0.66, 0.55];
        gl.uniform4f(at("soil"), red! * alpha!, green! * alpha!, blue! * alpha!, alpha!);
        gl.bindVertexArray(this.floor);
        gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
        gl.bindVertexArray(null);
    }
}

// Three signed bytes.
function packedNormal(normals: Float32Array, index: number): number {
    let packed = 0;
    for (let axis = 0; axis < 3; ++axis) {
        const value = Math.round(Math.max(-1, Math.min(1, normals[index + axis]!)) * 127);
        packed |= (value & 255) << (8 * axis);
    }
    return packed >>> 0;
}

// Square roots of linear colours, which are precise enough in the dark, and a flag for leaves.
function packedColour([red, green, blue]: readonly [number, number, number, ...number[]], isLeaf: boolean): number {
    const byte = (value: number) => Math.round(Math.sqrt(value) * 255);
    return (byte(red) | (byte(green) << 8) | (byte(blue) << 16) | ((isLeaf ? 255 : 0) << 24)) >>> 0;
}

export function middleOf({ low, high }: { low: Vector; high: Vector }): Vector {
    return [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
}

export function radiusOf({ low, high }: { low: Vector; high: Vector }): number {
    return Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2 || 1;
}

/// Half the shorter side of a picture that fits the frame from any azimuth at an elevation.
export function fittingHalf(
    { low, high }: { low: Vector; high: Vector },
    { elevation, distance }: Eye,
    width: number,
    height: number,
): number {
    const around = Math.hypot(high[0] - low[0], high[2] - low[2]) / 2;
    const tall = (high[1] - low[1]) / 2;
    const tilt = (Math.abs(elevation) * Math.PI) / 180;
    const up = tall * Math.cos(tilt) + around * Math.sin(tilt);
    const smaller = Math.min(width, height);
    const nearer = distance === null ? 1 : 1 + 0.5 / distance;
    return 1.08 * nearer * Math.max((around * smaller) / width, (up * smaller) / height) || 1;
}

function moved(point: Vector, { right, up }: ReturnType<typeof axes>, across: number, along: number): Vector {
    const place = (axis: 0 | 1 | 2) => point[axis] + right[axis] * across + up[axis] * along;
    return [place(0), place(1), place(2)];
}
