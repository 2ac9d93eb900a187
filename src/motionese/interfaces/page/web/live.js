// The one connection to the robot: messages out and in, and what is told when it is lost.

const PATIENCE_MS = [300, 600, 1200, 2500, 4000];
const REFUSED = [1008, 1009];

export class Live {
  /**
   * @param {(message: object) => void} received - called with every message.
   * @param {(state: "open"|"lost"|"refused", reason: string) => void} changed
   */
  constructor(received, changed) {
    this.received = received;
    this.changed = changed;
    this.attempts = 0;
    this.open = false;
  }

  /** Connect, and connect again whenever the connection is lost. */
  connect() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/live${location.search}`);
    this.socket = socket;
    socket.onopen = () => {
      this.open = true;
      this.greet(false);
      this.changed("open", "");
    };
    socket.onmessage = (event) => {
      this.attempts = 0;
      const message = JSON.parse(event.data);
      if (message.type === "session") sessionStorage.setItem("session", message.id);
      this.received(message);
    };
    socket.onclose = (event) => this.#closed(event);
  }

  /** Send a message; false where nobody is there to receive it. */
  send(message) {
    if (!this.open) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  /** Say hello; `take` takes the session over from the page that has it now. */
  greet(take) {
    const session = sessionStorage.getItem("session") ?? "";
    this.send({ type: "hello", session, take });
  }

  #closed({ code, reason }) {
    this.open = false;
    this.changed(REFUSED.includes(code) ? "refused" : "lost", reason);
    const wait = PATIENCE_MS[Math.min(this.attempts, PATIENCE_MS.length - 1)];
    this.attempts += 1;
    setTimeout(() => this.connect(), wait);
  }
}
