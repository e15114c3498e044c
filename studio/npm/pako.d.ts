// The zlib parts of pako 2.1, which have no types of their own.
declare module "pako/lib/zlib/*" {
    const part: any;
    export default part;
}
