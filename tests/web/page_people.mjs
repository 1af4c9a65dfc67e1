export async function people() {}
