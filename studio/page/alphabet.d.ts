export const alphabet: string;
