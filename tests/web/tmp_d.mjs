import { browser, open, settled, said } from "./browser.mjs";
for (const d of ["0", "1e+300", "5000", "0.01", "1e999", "x"]) {
  const page = await open({ width: 1280, fragment: encodeURIComponent(`table -n 0.1 -f 1000 -F d24 -m d3d ; page distance=${d}`) });
  await page.waitForTimeout(300);
  console.log(d, await page.evaluate(() => [document.querySelector("#error").textContent, ...[...document.querySelectorAll("#picture figcaption")].map((f) => f.innerText), document.querySelector("#distance-is").textContent, document.querySelector("#distance").value, location.hash]));
  await page.context().close();
}
console.log(said); await browser.close();
