// SPDX-License-Identifier: Apache-2.0
// The panels, in page order. A new panel needs a file in panels/ and a line here.
import type { Panel } from "./page";
import { bound } from "./panels/bound";
import { closure } from "./panels/closure";
import { compare } from "./panels/compare";
import { coverage } from "./panels/coverage";
import { cycles } from "./panels/cycles";
import { errors } from "./panels/errors";
import { errors_file } from "./panels/errors_file";
import { family } from "./panels/family";
import { pictures } from "./panels/pictures";
import { plan } from "./panels/plan";
import { propose } from "./panels/propose";
import { ranges } from "./panels/ranges";
import { runs } from "./panels/runs";
import { verify } from "./panels/verify";

export const panels: Panel[] = [pictures, compare, errors, errors_file, bound, ranges, propose, cycles, family, plan, verify, closure, coverage, runs];
