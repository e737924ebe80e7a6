// SPDX-License-Identifier: GPL-3.0-or-later
// Loads one known version of npm from the npm registry and unpacks it: node fetch_npm.mjs FOLDER
// gives FOLDER/package/bin/npm-cli.js. For machines that have Node but not npm: Debian's npm package
// needs 360 others. What was loaded must have the digest written here.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";

const version = "10.9.2"; // runs with Node 18.17 and later
const sha512 =
  "iriPEPIkoMYUy3F6f3wwSZAU93E0Eg6cHwIR6jzzOXWSy+SD/rOODEs74cVONHKSx2obXtuUoyidVEhISrisgQ==";

// The registry as npm itself would choose it: environment, the user's file, the machine's file.
function registry() {
  const asked = process.env.npm_config_registry ?? process.env.NPM_CONFIG_REGISTRY;
  if (asked) return asked;
  for (const file of [join(homedir(), ".npmrc"), "/etc/npmrc"]) {
    const line = existsSync(file) && /^\s*registry\s*=\s*(\S+)/m.exec(readFileSync(file, "utf8"));
    if (line) return line[1];
  }
  return "https://registry.npmjs.org/";
}

const folder = process.argv[2];
const address = `${registry().replace(/\/*$/, "")}/npm/-/npm-${version}.tgz`;
try {
  const answer = await fetch(address, { signal: AbortSignal.timeout(120_000) });
  if (!answer.ok) throw new Error(`answered ${answer.status}`);
  const archive = Buffer.from(await answer.arrayBuffer());
  const found = createHash("sha512").update(archive).digest("base64");
  if (found !== sha512) throw new Error(`has the digest ${found}, expected ${sha512}`);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  const file = join(folder, "npm.tgz");
  writeFileSync(file, archive);
  execFileSync("tar", ["-C", folder, "-xzf", file]);
  rmSync(file);
} catch (error) {
  rmSync(folder, { recursive: true, force: true });
  console.error(`setup: ${address}: ${error.cause?.message ?? error.message}`);
  process.exit(1);
}
