// The parts of pako 2.1 that are zlib itself; it has no types for them.
declare module "pako/lib/zlib/*" {
    const part: any;
    export default part;
}
