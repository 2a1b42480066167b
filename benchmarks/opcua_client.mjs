// A client of another make (node-opcua) weaves a carpet by `ilmek serve`: a job order, its progress, its end, an alarm subscription,
// and the refusals. Needs: npm install node-opcua-client
//
//   node benchmarks/opcua_client.mjs opc.tcp://127.0.0.1:4840/ilmek/loom USER < password.txt

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

// The package is looked for where the command is given, not where this file is.
const opcua = createRequire(join(process.cwd(), "package.json"))("node-opcua-client");
const { AttributeIds, DataType, MessageSecurityMode, OPCUAClient, SecurityPolicy, StatusCodes, UserTokenType, Variant } = opcua;

const [url, userName] = process.argv.slice(2);
const password = readFileSync(0, "utf-8").split("\n")[0];
const CONTROL = "Loom.MachineryBuildingBlocks.JobManagement.JobOrderControl";

function check(what, ok) {
  console.log(`${ok ? "ok    " : "FAILED"} ${what}`);
  if (!ok) process.exitCode = 1;
}

const options = {
  securityMode: MessageSecurityMode.SignAndEncrypt,
  securityPolicy: SecurityPolicy.Basic256Sha256,
  endpointMustExist: false,
  connectionStrategy: { maxRetry: 1 },
};
const client = OPCUAClient.create(options);
client.on("backoff", () => {});
await client.connect(url);
check("connected, signed and encrypted", true);

const refusedSession = await client
  .createSession({ type: UserTokenType.UserName, userName, password: "not the password" })
  .then(() => "accepted", (error) => error.message);
check(`wrong password: ${refusedSession.split("\n")[0]}`, refusedSession !== "accepted");
const anonymous = await client.createSession().then(() => "accepted", (error) => error.message);
check(`anonymous: ${anonymous.split("\n")[0]}`, anonymous !== "accepted");

const session = await client.createSession({ type: UserTokenType.UserName, userName, password });
check("session of the user", true);
const namespaces = await session.readNamespaceArray();
const index = namespaces.indexOf("urn:ilmek:loom");
const id = (path) => `ns=${index};s=${path}`;
const read = async (path) => (await session.read({ nodeId: id(path), attributeId: AttributeIds.Value })).value.value;

const written = await session.write({
  nodeId: id("Loom.Carpet.Knots"),
  attributeId: AttributeIds.Value,
  value: { value: { dataType: DataType.UInt32, value: 7 } },
});
check(`write: ${written.name}`, written === StatusCodes.BadUserAccessDenied);

const objects = await session.browse(`ns=${namespaces.indexOf("http://opcfoundation.org/UA/Machinery/")};i=1001`);
check("folder Machines has the loom", objects.references.some((one) => one.browseName.name === "Loom"));
check(`serial number ${await read("Loom.Identification.SerialNumber")}`, true);
check(`state ${await read("Loom.Status.State")}, ${await read("Loom.Carpet.KnotsTotal")} knots`, true);

const method = (path, inputArguments = []) =>
  session.call({ objectId: id(path.slice(0, path.lastIndexOf("."))), methodId: id(path), inputArguments });
const forbidden = await method("Loom.PackML.BaseStateMachine.MachineState.ExecuteState.Unhold");
check(`Unhold in that state: ${forbidden.statusCode.name}`, forbidden.statusCode === StatusCodes.BadInvalidState);

const seen = [];
const subscription = await session.createSubscription2({
  requestedPublishingInterval: 100,
  requestedLifetimeCount: 100,
  requestedMaxKeepAliveCount: 10,
  maxNotificationsPerPublish: 100,
  publishingEnabled: true,
});
const item = await subscription.monitor(
  { nodeId: id("Loom.Carpet.Knots"), attributeId: AttributeIds.Value },
  { samplingInterval: 100, discardOldest: true, queueSize: 100 },
  opcua.TimestampsToReturn.Both,
);
item.on("changed", (value) => seen.push(value.value.value));

const space = namespaces.indexOf("http://opcfoundation.org/UA/ISA95-JOBCONTROL_V2/");
const jobType = opcua.resolveNodeId(`ns=${space};i=3008`);
const order = await session.constructExtensionObject(jobType, { jobOrderID: "from-node" });
const started = await method(`${CONTROL}.StoreAndStart`, [
  new Variant({ dataType: DataType.ExtensionObject, value: order }),
  new Variant({ dataType: DataType.LocalizedText, arrayType: opcua.VariantArrayType.Array, value: [] }),
]);
const status = started.outputArguments?.[0]?.value;
check(`StoreAndStart: ${started.statusCode.name}, return status ${status}`, started.statusCode === StatusCodes.Good);

let state = "";
for (const end = Date.now() + 120_000; Date.now() < end && state !== "Ended"; ) {
  await new Promise((resolve) => setTimeout(resolve, 250));
  const jobs = await read(`${CONTROL}.JobOrderList`);
  const now = jobs[0].state[0].stateText.text;
  if (now !== state) console.log(`       job order ${jobs[0].jobOrder.jobOrderID}: ${now}, ${await read("Loom.Carpet.Knots")} knots`);
  state = now;
}
const [knots, total] = [await read("Loom.Carpet.Knots"), await read("Loom.Carpet.KnotsTotal")];
check(`the carpet is complete: ${knots} of ${total} knots, state ${await read("Loom.Status.State")}`, knots === total);
check(`${seen.length} values by subscription, in order`, seen.length > 2 && seen.every((one, at) => !at || one > seen[at - 1]));

await subscription.terminate();
await session.close();
await client.disconnect();
