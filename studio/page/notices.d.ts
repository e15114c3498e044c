// Made by notices.mjs while the page is built.
declare module "notices" {
    const notices: { name: string; what: string; version: string; licence: string; text: string }[];
    export default notices;
}
