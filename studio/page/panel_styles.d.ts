// The style sheets of the panels as one string; see build.mjs.
declare module "panel-styles" {
    const rules: string;
    export default rules;
}
