// Pattern files, imported as texts.
declare module "*.lsys" {
    const text: string;
    export default text;
}
