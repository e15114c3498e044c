// A worker's bundle, as the text that it is started from; build.mjs makes it.
declare module "worker:*" {
    const source: string;
    export default source;
}
