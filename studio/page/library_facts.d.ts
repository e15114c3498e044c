// Answers of the libraries, which build.mjs puts into the page.
declare module "library-facts" {
    const facts: {
        patterns: Omit<import("./protocol").PatternEntry, "text">[];
        arrangements: import("./protocol").ArrangementEntry[];
        help: import("./protocol").Help;
    };
    export default facts;
}
