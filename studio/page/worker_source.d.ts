// `import source from "worker:sound/render_worker.ts"`: the bundle of a worker as a string, for a Blob; see build.mjs.
declare module "worker:*" {
    const source: string;
    export default source;
}
